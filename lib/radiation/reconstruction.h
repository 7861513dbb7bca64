// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/cells.h"
#include "radiation/joint_config.h"
#include "radiation/measurement_batch.h"
#include "radiation/mlem_config.h"
#include "radiation/source_estimate.h"
#include "response/cone_density.h"
#include "response/response_table.h"

namespace comptonaut {

/// How all that was measured becomes one answer.
struct ReconstructionConfig {
  std::string nuclide = "Cs-137";
  std::string estimator = "joint";  ///< or "mlem"
  bool with_map = true;             ///< "joint" can do without
  MlemConfig mlem;
  JointConfig joint;
  int updates_max = 100;      ///< of the joint estimator
  double memory_max_B = 4e9;  ///< more than this is not tried
};

/// What of the measurements there was to work on.
struct MeasuredEvents {
  std::int64_t viewpoints = 0;  ///< with live time
  double live_s = 0.0;          ///< of all detectors together
  std::int64_t singles = 0;     ///< counted in live time
  std::int64_t photons = 0;     ///< Compton pairs
  std::int64_t cones = 0;       ///< their hypotheses
};

struct Reconstruction {
  std::string nuclide, estimator;
  MeasuredEvents events;
  /// Per cell: activity, Bq, and expected pairs per Bq, s. Always of the map of pairs (MLEM as published).
  std::vector<double> lambda_Bq, sensitivity_s;
  std::vector<SourceEstimate> sources;           ///< "joint": strongest first; "mlem": the map's maxima, highest first
  double map_change = SourceEstimate::kUnknown;  ///< share of events that the map's last iteration moved
  std::int64_t cones_outside = 0;                ///< that no cell can have caused
  bool converged = false;                        ///< "joint": a round of updates gained nothing
  int updates = 0;                               ///< "joint"
  double log_likelihood = SourceEstimate::kUnknown;  ///< "joint", up to a constant of the data
  double certificate_s = SourceEstimate::kUnknown;   ///< "joint": the largest score anywhere
  double coverage = SourceEstimate::kUnknown;        ///< "joint": share of the ground that is searched
};

[[nodiscard]] MeasuredEvents measured_events(std::span<const MeasurementBatch> batches, const std::string& nuclide);

/// Without what cannot have been measured over flat ground at ground_m: batches and cones from below it, which are
/// counted in `below`. Nothing below ground has live time either: what it would have seen is not missed.
[[nodiscard]] std::vector<MeasurementBatch> above_ground(std::vector<MeasurementBatch> batches, double ground_m,
                                                         std::int64_t& below);

/// The answer to all batches together. `progress`, where there is one, is told the share that is done, 0 to 1. The same
/// inputs give the same answer, bit for bit. Throws std::invalid_argument where there are no cells, where the estimator
/// is unknown or where the work takes more than memory_max_B.
[[nodiscard]] Reconstruction reconstruct(const ReconstructionConfig& config, const Cells& cells,
                                         const ResponseTable& response, const ConeDensity& cones,
                                         std::span<const MeasurementBatch> batches,
                                         const std::function<void(double)>& progress = {});

}  // namespace comptonaut
