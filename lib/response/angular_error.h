// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "detector/events.h"
#include "physics/transport.h"

namespace comptonaut {

/// A hypothesis of a simulated pair and where the source lay about it.
struct ConeView {
  double cos_alpha = 0.0;    ///< u . axis
  double cos_beta = 0.0;     ///< of the cone's half-angle
  double probability = 0.0;  ///< that the reader gives it; 0: not physical
};

/// How far the cone passes by the source, rad: delta = alpha - beta.
[[nodiscard]] double delta_rad(const ConeView& cone);

/// A pair and the truth about the photon that made it.
struct SimulatedPair {
  ConeView a, b;
  std::optional<bool> a_is_true;  ///< cluster 1 is where the photon scattered first; nullopt: it did not scatter first
  double weight = 1.0;            ///< photons that it stands for
};

/// Compares a pair with the photon that made it. Its first deposit tells where it interacted first; that cluster is
/// taken for the scatterer whose centroid is nearer across the chip.
[[nodiscard]] SimulatedPair compare_with_photon(const DetectorEvent& pair, std::span<const Deposit> deposits,
                                                const Eigen::Vector3d& u_D, const SensorConfig& sensor);

/// Least |delta| of the physical hypotheses, rad.
[[nodiscard]] double best_error_rad(const SimulatedPair& pair);
/// |delta| of the true hypothesis, where there is one and the reader kept it, rad.
[[nodiscard]] std::optional<double> true_error_rad(const SimulatedPair& pair);

/// Statistics over many pairs; angles rad, 0 where there are none.
struct AngularSummary {
  std::int64_t pairs = 0;
  double a_is_true = 0.0;  ///< share of the pairs that have a true hypothesis
  double has_truth = 0.0;  ///< share of pairs whose photon scattered first
  double best_median_rad = 0.0, best_q95_rad = 0.0;
  double true_median_rad = 0.0, true_q95_rad = 0.0;
};

[[nodiscard]] AngularSummary summarize(std::span<const SimulatedPair> pairs);

/// Hypotheses whose stated probability lies in [from, to): how many and which share of them is true.
struct ReliabilityBin {
  double from = 0.0, to = 0.0;
  double hypotheses = 0.0;  ///< number
  double stated = 0.0;      ///< mean, by weight
  double is_true = 0.0;     ///< share, by weight
  double weight = 0.0;
};

/// Calibration of the hypotheses' probabilities: hypotheses that the reader gives 30 % should be true in 30 % of all
/// cases. Ten bins for pairs that kept both hypotheses, the last [1, 1] for hypotheses that stand alone. Pairs whose
/// photon did not scatter first count with no true hypothesis.
[[nodiscard]] std::vector<ReliabilityBin> reliability(std::span<const SimulatedPair> pairs);

}  // namespace comptonaut
