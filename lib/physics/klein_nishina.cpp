// SPDX-License-Identifier: BSD-3-Clause
#include "physics/klein_nishina.h"

#include <cmath>
#include <numbers>

#include "physics/kinematics.h"

namespace comptonaut {

double klein_nishina_m2_sr(double energy_keV, double cos_angle) {
  const double p = scattered_keV(energy_keV, cos_angle) / energy_keV;
  return 0.5 * kElectronRadius_m * kElectronRadius_m * p * p * (p + 1.0 / p - (1.0 - cos_angle * cos_angle));
}

double klein_nishina_m2(double energy_keV) {
  const double k = energy_keV / kElectronMass_keV;
  const double k1 = 1.0 + 2.0 * k;
  const double log = std::log1p(2.0 * k);
  double f = (1.0 + k) / (k * k) * (2.0 * (1.0 + k) / k1 - log / k) + log / (2.0 * k) - (1.0 + 3.0 * k) / (k1 * k1);
  if (k < 0.01) {  // the closed form loses digits to cancellation: its series
    f = 4.0 / 3.0 * (1.0 + k * (-2.0 + k * (5.2 + k * (-13.3 + k * (1144.0 / 35.0 + k * (-544.0 / 7.0))))));
  }
  return 2.0 * std::numbers::pi * kElectronRadius_m * kElectronRadius_m * f;
}

double sample_klein_nishina(double energy_keV, Random& random) {
  // P = E'/E has the density (1/P + P) (1 - P sin^2 / (1 + P^2)) on [P_min, 1]: drawn from 1/P or from P, then accepted
  // with the second factor.
  const double k = energy_keV / kElectronMass_keV;
  const double p_min = 1.0 / (1.0 + 2.0 * k);
  const double weight_inverse = -std::log(p_min);
  const double weight_linear = 0.5 * (1.0 - p_min * p_min);
  while (true) {
    const bool inverse = random.uniform() * (weight_inverse + weight_linear) < weight_inverse;
    const double u = random.uniform();
    const double p = inverse ? std::exp(-weight_inverse * u) : std::sqrt(p_min * p_min + (1.0 - p_min * p_min) * u);
    const double t = (1.0 - p) / (k * p);  // 1 - cos
    const double sin2 = t * (2.0 - t);
    if (random.uniform() < 1.0 - p * sin2 / (1.0 + p * p)) return 1.0 - t;
  }
}

}  // namespace comptonaut
