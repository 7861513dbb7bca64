// SPDX-License-Identifier: BSD-3-Clause
#include "physics/compton.h"

#include <cmath>

#include "physics/kinematics.h"
#include "physics/klein_nishina.h"

namespace comptonaut {
namespace {

std::size_t sample_shell(const Atom& atom, Random& random) {
  double left = random.uniform() * atom.z;
  std::size_t i = 0;
  while (i + 1 < atom.shells.size() && left >= atom.shells[i].electrons) left -= atom.shells[i++].electrons;
  return i;
}

/// From the density (1 + x^2)^-3: Student's t with five degrees of freedom, over sqrt(5).
double sample_profile(Random& random) {
  const double normal = random.normal();
  const double chi2 = normal * normal + 2.0 * (random.exponential() + random.exponential());
  return random.normal() / std::sqrt(chi2);
}

}  // namespace

double doppler_keV(double energy_keV, double cos_angle, double momentum_mc) {
  const double tau = scattered_keV(energy_keV, cos_angle) / energy_keV;
  const double t = momentum_mc * momentum_mc;
  const double a = 1.0 - t * tau * tau;
  const double b = 1.0 - t * tau * cos_angle;
  const double root = std::sqrt(std::fmax(b * b - a * (1.0 - t), 0.0));
  return energy_keV * tau / a * (b + std::copysign(root, momentum_mc));
}

ComptonScatter sample_compton(const Atom& atom, double energy_keV, Random& random) {
  while (true) {
    const double cos_angle = sample_klein_nishina(energy_keV, random);
    const std::size_t shell = sample_shell(atom, random);
    const double binding_keV = atom.shells[shell].binding_keV;
    const double p0_mc = std::sqrt(2.0 * binding_keV / kElectronMass_keV);
    const double momentum_mc = p0_mc * sample_profile(random);
    if (!(std::abs(momentum_mc) < 1.0)) continue;
    const double photon_keV = doppler_keV(energy_keV, cos_angle, momentum_mc);
    if (photon_keV > 0.0 && photon_keV <= energy_keV - binding_keV) return {cos_angle, photon_keV, shell};
  }
}

}  // namespace comptonaut
