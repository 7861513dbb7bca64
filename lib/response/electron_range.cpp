// SPDX-License-Identifier: BSD-3-Clause
#include "response/electron_range.h"

#include <cmath>

#include "physics/kinematics.h"

namespace comptonaut {
namespace {

constexpr double kExponent = 1.67;
const double kUm = 0.0276 * 120.0 / (std::pow(50.0, 0.889) * 5.85);
constexpr double kRadiationLength_um = 15.2e3;

}  // namespace

double electron_range_um(double energy_keV) { return kUm * std::pow(energy_keV, kExponent); }

double energy_of_range_keV(double range_um) { return std::pow(range_um / kUm, 1.0 / kExponent); }

double multiple_scattering_rad(double energy_keV, double length_um) {
  const double momentum_velocity_keV =
      energy_keV * (energy_keV + 2.0 * kElectronMass_keV) / (energy_keV + kElectronMass_keV);
  const double lengths = length_um / kRadiationLength_um;
  return 13.6e3 / momentum_velocity_keV * std::sqrt(lengths) * (1.0 + 0.038 * std::log(lengths));
}

}  // namespace comptonaut
