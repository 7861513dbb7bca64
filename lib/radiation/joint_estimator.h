// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/cells.h"
#include "radiation/joint_config.h"
#include "radiation/joint_fit.h"
#include "radiation/joint_map.h"
#include "radiation/joint_model.h"
#include "radiation/look.h"
#include "radiation/measurement_batch.h"
#include "radiation/patches.h"
#include "radiation/point_sources.h"
#include "radiation/score_map.h"
#include "radiation/source_estimate.h"
#include "world/world.h"

namespace comptonaut {

/// Point sources from pairs and singles together (design, section 5.4). Its state is a function of the batches in the
/// order of their adding and of when it was updated. Beside them, a map of what they do not explain.
class JointEstimator {
 public:
  /// `cells` must outlive the estimator. `world` holds the obstacles between sources and detectors.
  JointEstimator(const JointConfig& config, const Cells& cells, std::string nuclide, JointPhysics physics,
                 const World& world = World::flat());
  JointEstimator(const JointConfig& config, const Cells& cells, std::string nuclide, const ResponseTable& response,
                 const ConeDensity& cones);

  void add(const MeasurementBatch& batch);

  /// The terrain is otherwise than it was: other obstacles, other `cells` (which must outlive the estimator). The next
  /// update computes from the data all that depends on it; sources keep their heights above the ground.
  void set_terrain(const Cells& cells, const World& world);

  /// What is known now of the sources of other nuclides, whose lines leave something in this one's channel; as
  /// JointPhysics::of_others. They are fitted along and not reported.
  void set_known(std::vector<KnownSource> known);

  /// Improves the sources on all data, then the map of what is left by config.map_steps at most, both from where they
  /// were.
  void update();

  /// Where points do not explain the data (discs_of), strongest first. Their ground shows in the map.
  [[nodiscard]] const std::vector<PatchEstimate>& patches() const { return patches_; }
  /// Per place, Bq: above which activity it is clear of another source, up to a chance of 5 % (ScoreMap).
  [[nodiscard]] std::vector<double> clear_above_Bq() const;
  [[nodiscard]] const Cells& clearance_places() const { return map_.places(); }

  /// Of what the sources do not explain.
  [[nodiscard]] const JointMap& ground_map() const { return ground_map_; }
  /// How far the map came in the last update.
  [[nodiscard]] const Convergence& map_convergence() const { return map_convergence_; }

  /// Of the last update, strongest first, with intervals; without those that a patch stands for.
  [[nodiscard]] const std::vector<SourceEstimate>& sources() const { return estimates_; }
  /// The same with those that a patch stands for.
  [[nodiscard]] const std::vector<SourceEstimate>& points() const { return points_; }
  /// Where sources of other nuclides are by what was known of them and by this channel's data; in the order of
  /// set_known. The rest of these estimates is of what they leave here.
  [[nodiscard]] const std::vector<SourceEstimate>& known() const { return known_; }
  /// The largest score anywhere on the ground, seconds (log likelihood per Bq); 0 where nothing pulls.
  [[nodiscard]] double certificate_s() const { return certificate_s_; }
  /// Sources that are not told, since an obstacle a voxel beside its place would explain them as well.
  [[nodiscard]] std::int64_t doubtful() const { return doubtful_; }
  /// Share of the ground where a source hides with a chance below 5 % (design, section 6.3).
  [[nodiscard]] double coverage() const { return coverage_; }
  /// What was counted in each batch beside what the model of the last update says.
  [[nodiscard]] std::vector<Look> looks() const;
  [[nodiscard]] const JointModel& model() const { return state_.model; }
  [[nodiscard]] double log_likelihood() const { return state_.log_likelihood; }
  [[nodiscard]] const JointData& data() const { return data_; }

 private:
  [[nodiscard]] JointProblem problem() const { return {.config = config_, .physics = physics_, .data = data_}; }

  [[nodiscard]] JointMap new_map(const Cells& cells) const { return {{.steps_max = config_.map_steps}, cells}; }

  JointConfig config_;
  std::string nuclide_;
  JointPhysics physics_;
  JointData data_;
  Ground ground_;
  ScoreMap map_;
  JointMap ground_map_;
  Convergence map_convergence_;
  JointState state_;
  std::vector<SourceEstimate> known_, points_, estimates_;
  std::vector<SourceDisc> discs_;
  std::vector<PatchEstimate> patches_;
  double certificate_s_ = 0.0;
  double coverage_ = 0.0;
  std::size_t updates_ = 0;
  std::int64_t doubtful_ = 0;
};

/// The sources of a state, in its order, with their uncertainty, from the information about all parameters together. A
/// source on the surface has no uncertainty of its height.
[[nodiscard]] std::vector<SourceEstimate> estimates_of(const JointProblem& problem, const Ground& ground,
                                                       const JointState& state, const std::string& nuclide);

}  // namespace comptonaut
