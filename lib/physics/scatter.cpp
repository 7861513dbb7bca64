// SPDX-License-Identifier: BSD-3-Clause
#include "physics/scatter.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "physics/kinematics.h"

namespace comptonaut {
namespace {

constexpr double kHbarC_keV_nm = 0.1973269804;
constexpr double kBohr_nm = 0.0529177211;

}  // namespace

Eigen::Vector3d deflect(const Eigen::Vector3d& direction, double cos_angle, Random& random) {
  const Eigen::Vector3d e1 = direction.unitOrthogonal();
  const Eigen::Vector3d e2 = direction.cross(e1);
  const double phi = random.uniform(0.0, 2.0 * std::numbers::pi);
  const double sin_angle = std::sqrt(std::fmax(1.0 - cos_angle * cos_angle, 0.0));
  return (cos_angle * direction + sin_angle * (std::cos(phi) * e1 + std::sin(phi) * e2)).normalized();
}

double sample_rayleigh(int z, double energy_keV, Random& random) {
  const double a_nm = 0.8853 * kBohr_nm / std::cbrt(static_cast<double>(z));
  const double most = std::pow(2.0 * energy_keV * a_nm / kHbarC_keV_nm, 2);  // (q a)^2 of backscatter
  while (true) {
    const double u = random.uniform();
    const double x = u * most / (1.0 + most * (1.0 - u));  // density (1 + x)^-2 on [0, most]
    const double cos_angle = 1.0 - 2.0 * x / most;
    if (2.0 * random.uniform() < 1.0 + cos_angle * cos_angle) return cos_angle;
  }
}

double sample_photoelectron(double electron_keV, Random& random) {
  const double gamma = 1.0 + electron_keV / kElectronMass_keV;
  const double beta = std::sqrt(1.0 - 1.0 / (gamma * gamma));
  const double a = 1.0 / beta - 1.0;
  const double b = 0.5 * beta * gamma * (gamma - 1.0) * (gamma - 2.0);
  const auto accept = [&](double nu) { return (2.0 - nu) * (1.0 / (a + nu) + b); };
  while (true) {
    const double u = random.uniform();
    const double nu = 2.0 * a / ((a + 2.0) * (a + 2.0) - 4.0 * u) * (2.0 * u + (a + 2.0) * std::sqrt(u));
    if (random.uniform() * accept(0.0) < accept(nu)) return 1.0 - nu;
  }
}

}  // namespace comptonaut
