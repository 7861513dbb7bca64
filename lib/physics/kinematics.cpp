// SPDX-License-Identifier: BSD-3-Clause
#include "physics/kinematics.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace comptonaut {
namespace {

void require(bool right, const char* name, double value, const char* what) {
  if (!right || !std::isfinite(value)) {
    throw std::invalid_argument(fmt::format("{} is {} keV, must be {} and finite", name, value, what));
  }
}

std::optional<double> cosine(double before_keV, double after_keV) {
  const double cos_beta = 1.0 + kElectronMass_keV * (1.0 / before_keV - 1.0 / after_keV);
  return cos_beta >= -1.0 && cos_beta <= 1.0 ? std::optional(cos_beta) : std::nullopt;
}

}  // namespace

double scattered_keV(double energy_keV, double cos_angle) {
  return energy_keV / (1.0 + energy_keV / kElectronMass_keV * (1.0 - cos_angle));
}

double compton_edge_keV(double energy_keV) { return energy_keV - scattered_keV(energy_keV, -1.0); }

std::optional<double> scatter_cosine(double e_electron_keV, double e_photon_keV) {
  require(e_electron_keV > 0.0, "the electron's energy", e_electron_keV, "positive");
  require(e_photon_keV > 0.0, "the photon's energy", e_photon_keV, "positive");
  return cosine(e_electron_keV + e_photon_keV, e_photon_keV);
}

PairEnergies constrain_to_line(const PairEnergies& measured, const PairEnergies& sigma, double line_keV) {
  const double variance = sigma.electron_keV * sigma.electron_keV + sigma.photon_keV * sigma.photon_keV;
  if (variance == 0.0) return measured;
  const double missing_keV = line_keV - measured.electron_keV - measured.photon_keV;
  const double electron_share = sigma.electron_keV * sigma.electron_keV / variance;
  return {.electron_keV = measured.electron_keV + electron_share * missing_keV,
          .photon_keV = measured.photon_keV + (1.0 - electron_share) * missing_keV};
}

std::optional<double> scatter_cosine_of_line(const PairEnergies& measured, const PairEnergies& sigma, double line_keV) {
  require(measured.electron_keV > 0.0, "the electron's energy", measured.electron_keV, "positive");
  require(measured.photon_keV > 0.0, "the photon's energy", measured.photon_keV, "positive");
  require(sigma.electron_keV >= 0.0, "the electron's sigma", sigma.electron_keV, "0 or more");
  require(sigma.photon_keV >= 0.0, "the photon's sigma", sigma.photon_keV, "0 or more");
  require(line_keV > 0.0, "the line's energy", line_keV, "positive");
  const PairEnergies fitted = constrain_to_line(measured, sigma, line_keV);
  if (!(fitted.electron_keV > 0.0 && fitted.photon_keV > 0.0)) return std::nullopt;
  return cosine(line_keV, fitted.photon_keV);
}

}  // namespace comptonaut
