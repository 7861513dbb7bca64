// SPDX-License-Identifier: BSD-3-Clause
#include "detector/pair.h"

#include <algorithm>
#include <cmath>

#include "physics/kinematics.h"
#include "physics/klein_nishina.h"

namespace comptonaut {
namespace {

constexpr double kCdTeElectrons_per_m3 = 1.4678e30;

/// One reading of the two energies: which is the electron's.
struct Reading {
  double cos_beta = 0.0;
  double weight = 0.0;  ///< 0: not physical
};

/// The photon's energy by which the angle is told, within what a photon of e_0 can have left.
double fitted_photon_keV(const SensorConfig& sensor, double e_0_keV, double electron_keV, double photon_keV) {
  const PairEnergies sigma{energy_sigma_keV(sensor, electron_keV), energy_sigma_keV(sensor, photon_keV)};
  const PairEnergies fitted = constrain_to_line({electron_keV, photon_keV}, sigma, e_0_keV);
  return std::clamp(fitted.photon_keV, scattered_keV(e_0_keV, -1.0), e_0_keV);
}

Reading read(const SensorConfig& sensor, const NuclideChannel& channel, double e_0_keV, double electron_keV,
             double photon_keV, double distance_m) {
  const double edge_keV = compton_edge_keV(channel.line_keV);
  const double electron_max_keV = edge_keV + channel.pair_sigmas * energy_sigma_keV(sensor, electron_keV);
  const double photon_min_keV =
      channel.line_keV - edge_keV - channel.pair_sigmas * energy_sigma_keV(sensor, photon_keV);
  if (electron_keV > electron_max_keV || photon_keV < photon_min_keV) return {};

  const double e_2_keV = fitted_photon_keV(sensor, e_0_keV, electron_keV, photon_keV);
  const double cos_beta = std::clamp(1.0 + kElectronMass_keV * (1.0 / e_0_keV - 1.0 / e_2_keV), -1.0, 1.0);
  // Per energy instead of per solid angle: d(cos beta) / d(E_2) = m_e c^2 / E_2^2.
  const double scatter = klein_nishina_m2_sr(e_0_keV, cos_beta) * std::pow(e_0_keV / e_2_keV, 2);
  const double photoelectric_per_m = cdte_photoelectric_per_m(e_2_keV);
  const double attenuation_per_m = photoelectric_per_m + cdte_compton_per_m(e_2_keV);
  return {cos_beta, scatter * photoelectric_per_m * std::exp(-attenuation_per_m * distance_m)};
}

}  // namespace

double depth_difference_um(const SensorConfig& sensor, const Cluster& first, const Cluster& second) {
  return -drift_velocity_um_ns(sensor) * between_ns(first, second);
}

std::optional<PairHypotheses> pair_hypotheses(const SensorConfig& sensor, const NuclideChannel& channel,
                                              bool constrain_to_line, const Cluster& first, const Cluster& second) {
  const double sum_keV = first.energy_keV + second.energy_keV;
  if (std::abs(sum_keV - channel.line_keV) > channel.pair_sum_rel_window * channel.line_keV) return std::nullopt;

  const Eigen::Vector3d p_D1 = pixel_to_D(sensor, first.x_px, first.y_px, depth_difference_um(sensor, first, second));
  const Eigen::Vector3d p_D2 = pixel_to_D(sensor, second.x_px, second.y_px);
  const Eigen::Vector3d between_D = p_D1 - p_D2;
  const double distance_m = between_D.norm();
  const double e_0_keV = constrain_to_line ? channel.line_keV : sum_keV;
  const Reading a = read(sensor, channel, e_0_keV, first.energy_keV, second.energy_keV, distance_m);
  const Reading b = read(sensor, channel, e_0_keV, second.energy_keV, first.energy_keV, distance_m);
  const double weight = a.weight + b.weight;
  if (!(weight > 0.0 && distance_m > 0.0)) return std::nullopt;

  const Eigen::Vector3d axis_D = between_D / distance_m;  // a photon that scattered in 1 came from 1's side
  return PairHypotheses{.a = {.axis_D = axis_D, .cos_beta = a.cos_beta, .probability = a.weight / weight},
                        .b = {.axis_D = -axis_D, .cos_beta = b.cos_beta, .probability = b.weight / weight}};
}

double cdte_photoelectric_per_m(double energy_keV) {
  const double x = std::log(std::max(energy_keV, 50.0) / 200.0);
  return 100.0 * std::exp(0.150055 + x * (-2.851563 + x * (0.0873567 + x * 0.0673441)));
}

double cdte_compton_per_m(double energy_keV) { return kCdTeElectrons_per_m3 * klein_nishina_m2(energy_keV); }

}  // namespace comptonaut
