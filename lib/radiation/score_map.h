// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <map>
#include <vector>

#include "core/cells.h"
#include "radiation/cell_centres.h"
#include "radiation/joint_model.h"

namespace comptonaut {

/// What the likelihood's terms pull with: g(m) = sum_v singles[v] a_v(m) + sum_i pairs[i] t_i(m)
/// - sum_d exposure[d] s^c_d(m), the derivative of log L by the activity of a source at m.
struct Residuals {
  std::vector<double> singles;   ///< scale_d scatter (n_v / mu_v - 1)
  std::vector<double> pairs;     ///< scale_d / f_i
  std::vector<double> exposure;  ///< per drone: scale_d
};

[[nodiscard]] Residuals residuals(const JointProblem& problem, const JointState& state);

/// g at one place, exactly; in seconds (log likelihood per Bq).
[[nodiscard]] double score(const JointProblem& problem, const Residuals& residuals, const Eigen::Vector3d& p_W);

/// A place where g / sqrt(s) has a local maximum.
struct ScoreMaximum {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();
  double score_s = 0.0;  ///< g
  double pull = 0.0;     ///< g / sqrt(s)
};

/// The score on a coarse grid of the ground, cheap enough to be had at every update: viewpoints of one block of air are
/// taken as one, in its middle. It says where to look; how much a source there gains is computed exactly.
class ScoreMap {
 public:
  /// Nodes: the mean of the cells in each square of `spacing_m`.
  ScoreMap(const Cells& cells, double spacing_m);

  /// Takes in what was appended to the data since the last call; earlier data must not have changed.
  void extend(const JointProblem& problem);

  /// The highest local maxima with g > 0, at most `count`, highest pull first (ties: lower node). `extend` before.
  [[nodiscard]] std::vector<ScoreMaximum> maxima(const JointProblem& problem, const Residuals& residuals,
                                                 int count) const;

  /// S per node, s: the sensitivity of singles and pairs together, singles of a viewpoint weighted by the share of a
  /// source of activity_min_Bq among all that is expected there: background and known sources are no signal.
  [[nodiscard]] std::vector<double> corrected_sensitivity_s(const JointProblem& problem, const JointState& state) const;

  /// Per node, Bq: the activity that another source there exceeds with a chance of `chance` only (upper_limit_Bq), the
  /// state held as it is. Counts of one block of air are taken together.
  [[nodiscard]] std::vector<double> clear_above_Bq(const JointProblem& problem, const JointState& state,
                                                   double chance) const;

  [[nodiscard]] const Cells& places() const { return nodes_; }
  [[nodiscard]] std::size_t nodes() const { return nodes_.size(); }

 private:
  struct Block {
    std::vector<float> kernel;       ///< per node, padded: L^p exp(-mu d) / d^2 and what obstacles let through
    std::vector<float> let_through;  ///< per node; empty: all
  };
  [[nodiscard]] std::size_t block_of(const JointProblem& problem, std::size_t viewpoint);
  void add_viewpoint(const JointPhysics& physics, const Viewpoints& viewpoints, std::size_t at);
  void add_pair(const JointProblem& problem, const Pair& pair);
  [[nodiscard]] std::vector<double> scores(const JointProblem& problem, const Residuals& residuals) const;

  Cells nodes_;
  CellCentres centres_;
  std::vector<Eigen::Vector3d> surface_W_;  ///< of each node, the cell nearest to it: rays begin on a surface
  std::map<VoxelKey, std::size_t> block_at_;
  std::vector<Block> blocks_;
  std::vector<std::size_t> block_of_viewpoint_;
  std::vector<std::vector<float>> pair_rows_;    ///< per pair and node, padded: t_i
  std::vector<std::vector<double>> exposure_s_;  ///< per drone and node: s^c
  std::vector<double> singles_s_;                ///< per node: s^p
};

}  // namespace comptonaut
