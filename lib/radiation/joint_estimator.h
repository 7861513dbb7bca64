// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/cells.h"
#include "radiation/joint_config.h"
#include "radiation/joint_fit.h"
#include "radiation/joint_model.h"
#include "radiation/measurement_batch.h"
#include "radiation/point_sources.h"
#include "radiation/score_map.h"
#include "radiation/source_estimate.h"

namespace comptonaut {

/// Point sources from pairs and singles together (design, section 5.4). Its state is a function of the batches in the
/// order of their adding and of when it was updated.
class JointEstimator {
 public:
  JointEstimator(const JointConfig& config, const Cells& cells, std::string nuclide, const ResponseTable& response,
                 const ConeDensity& cones);

  void add(const MeasurementBatch& batch);

  /// Improves the sources on all data.
  void update();

  /// Of the last update, strongest first, with intervals.
  [[nodiscard]] const std::vector<SourceEstimate>& sources() const { return estimates_; }
  /// The largest score anywhere on the ground, seconds (log likelihood per Bq); 0 where nothing pulls.
  [[nodiscard]] double certificate_s() const { return certificate_s_; }
  /// Share of the ground where a source hides with a chance below 5 % (design, section 6.3).
  [[nodiscard]] double coverage() const { return coverage_; }
  [[nodiscard]] const JointModel& model() const { return state_.model; }
  [[nodiscard]] double log_likelihood() const { return state_.log_likelihood; }

 private:
  [[nodiscard]] JointProblem problem() const { return {.config = config_, .physics = physics_, .data = data_}; }

  JointConfig config_;
  std::string nuclide_;
  JointPhysics physics_;
  JointData data_;
  Ground ground_;
  ScoreMap map_;
  JointState state_;
  std::vector<SourceEstimate> estimates_;
  double certificate_s_ = 0.0;
  double coverage_ = 0.0;
  std::size_t updates_ = 0;
};

/// The sources of a state with their uncertainty, from the information about all parameters together; strongest first.
/// A source on the surface has no uncertainty of its height.
[[nodiscard]] std::vector<SourceEstimate> estimates_of(const JointProblem& problem, const Ground& ground,
                                                       const JointState& state, const std::string& nuclide);

}  // namespace comptonaut
