// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>

#include "detector/events.h"
#include "physics/transport.h"

namespace comptonaut {

/// How far a pair's cones pass by the source: delta = angle(u, axis) - beta.
struct AngularError {
  double best_rad = 0.0;           ///< least |delta| of the physical hypotheses
  std::optional<double> true_rad;  ///< |delta| of the true hypothesis, where there is one and it is physical
  std::optional<bool> a_is_true;   ///< cluster 1 is where the photon scattered first; nullopt: it did not scatter
};

/// Compares a pair with the photon that made it. Its first deposit tells where it interacted first; that cluster is
/// taken for the scatterer whose centroid is nearer across the chip.
[[nodiscard]] AngularError angular_error(const DetectorEvent& pair, std::span<const Deposit> deposits,
                                         const Eigen::Vector3d& u_D, const SensorConfig& sensor);

/// Statistics over many pairs; angles rad, 0 where there are none.
struct AngularSummary {
  std::int64_t pairs = 0;
  double a_is_true = 0.0;  ///< share of the pairs that have a true hypothesis
  double has_truth = 0.0;  ///< share of pairs whose photon scattered first
  double best_median_rad = 0.0, best_q95_rad = 0.0;
  double true_median_rad = 0.0, true_q95_rad = 0.0;
};

[[nodiscard]] AngularSummary summarize(std::span<const AngularError> errors);

}  // namespace comptonaut
