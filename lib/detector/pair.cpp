// SPDX-License-Identifier: BSD-3-Clause
#include "detector/pair.h"

#include <cmath>

namespace comptonaut {
namespace {

ClusterEnergy energy_of(const SensorConfig& sensor, const Cluster& cluster) {
  const double energy_keV = deposited_keV(sensor, cluster.energy_keV);
  return {.energy_keV = energy_keV, .sigma_keV = energy_sigma_keV(sensor, energy_keV)};
}

bool is_physical(const NuclideChannel& channel, const ClusterEnergy& electron) {
  return electron.energy_keV <= two_scatters_keV(channel.line_keV) + channel.pair_sigmas * electron.sigma_keV;
}

ConeHypothesis cone_of(const Reading& reading, const Eigen::Vector3d& axis_D, double likelihood) {
  return {.axis_D = axis_D, .cos_beta = std::cos(reading.beta_rad), .probability = reading.likelihood / likelihood};
}

}  // namespace

double depth_difference_um(const SensorConfig& sensor, const Cluster& first, const Cluster& second) {
  return -drift_velocity_um_ns(sensor) * between_ns(first, second);
}

std::optional<PairHypotheses> pair_hypotheses(const SensorConfig& sensor, const NuclideChannel& channel,
                                              const PairReader& reader, const Cluster& first, const Cluster& second) {
  const double sum_keV = first.energy_keV + second.energy_keV;
  if (std::abs(sum_keV - channel.line_keV) > channel.pair_sum_rel_window * channel.line_keV) return std::nullopt;

  const Eigen::Vector3d p_D1 = pixel_to_D(sensor, first.x_px, first.y_px, depth_difference_um(sensor, first, second));
  const Eigen::Vector3d p_D2 = pixel_to_D(sensor, second.x_px, second.y_px);
  const double distance_m = (p_D1 - p_D2).norm();
  const ClusterEnergy energy_1 = energy_of(sensor, first), energy_2 = energy_of(sensor, second);
  const Reading a = is_physical(channel, energy_1) ? reader.read(energy_1, energy_2, distance_m) : Reading{};
  const Reading b = is_physical(channel, energy_2) ? reader.read(energy_2, energy_1, distance_m) : Reading{};
  const double likelihood = a.likelihood + b.likelihood;
  if (!(likelihood > 0.0 && distance_m > 0.0)) return std::nullopt;

  const Eigen::Vector3d axis_D = (p_D1 - p_D2) / distance_m;  // a photon that scattered in 1 came from 1's side
  return PairHypotheses{.a = cone_of(a, axis_D, likelihood), .b = cone_of(b, -axis_D, likelihood)};
}

}  // namespace comptonaut
