// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/cells.h"
#include "radiation/joint_model.h"
#include "radiation/map_rows.h"
#include "radiation/map_state.h"

namespace comptonaut {

struct JointMapConfig {
  MapResolution resolution;
  int steps_max = 200;        ///< per update
  bool accelerated = true;    ///< false: plain steps of expectation maximisation
  double gain_min = 1e-3;     ///< in log likelihood: a step that gains less is the last
  double floor_share = 1e-3;  ///< of the expected counts, spread evenly: what an update lifts cells to that want more
};

/// How far an update came.
struct Convergence {
  int steps = 0;                ///< projections of all rows
  double log_likelihood = 0.0;  ///< up to a constant of the data and of what is held fixed
  double gain = 0.0;            ///< of the last step, or what the next one promised
  bool reached = false;         ///< gain below gain_min
};

/// MLEM on the joint likelihood (design, section 5.4 a): activity of the ground and the drones' background rates, from
/// pairs and singles together, while what point sources explain is held fixed.
///   f_i  = g_d sum_j t_ij lambda_j + held_i + b_c,d / (4 pi)             pairs
///   mu_r = g_d k sum_j a_rj lambda_j + held_r + b_p,d Delta_r            singles of a block of air
///   s_j  = sum_d g_d (s^c_dj + k s^p_dj)        g: the drones' scale, k: the model's scatter
///   lambda_j <- lambda_j / s_j [ sum_i g_d t_ij / f_i + sum_r g_d k a_rj n_r / mu_r ]
/// and the rates likewise, each step started from where the one before would have gone on to [Nesterov 1983], until few
/// enough cells hold activity for Newton's steps (MapSupport), which end at the maximum itself. A step that lost
/// likelihood is taken back: the likelihood never falls. The map lives on the leaves of a quadtree that
/// is as fine as what was measured nearby (MapRows). Its state is a function of the data in the order of their adding
/// and of the updates.
class JointMap {
 public:
  /// `cells` must outlive the map.
  JointMap(const JointMapConfig& config, const Cells& cells);

  /// Takes in what was appended to the data since the last call; of earlier data only the turns of the detectors may
  /// have changed (MapRows).
  void extend(const JointPhysics& physics, const JointData& data);

  /// Improves the map from where it was. `model`: scale and scatter, and the rates to start from. `held`: what sources
  /// that are not in the map give, without background: singles per viewpoint and densities per pair (`sources_only`),
  /// or both empty. `model.drones` is as in the data's senders.
  Convergence update(const JointProblem& problem, const JointModel& model, const Expected& held);

  /// Over the cells, Bq; leaves of several cells spread evenly over them. All zeros before the first update.
  [[nodiscard]] std::vector<double> lambda_Bq() const;
  /// s_j of the last update over the cells, s.
  [[nodiscard]] std::vector<double> sensitivity_s() const;
  /// That of pairs alone, at the table's response.
  [[nodiscard]] std::vector<double> pair_sensitivity_s() const;
  /// Background rates of the last update; scale as in its model.
  [[nodiscard]] const std::vector<DroneModel>& drones() const { return state_.drones; }
  [[nodiscard]] const MapRows& rows() const { return rows_; }

 private:
  [[nodiscard]] std::vector<double> over_cells(const std::vector<NodeField>& of_leaves) const;
  [[nodiscard]] std::vector<NodeField> sensitivity(const JointConfig& config, const JointModel& model) const;
  void start(const JointModel& model);
  [[nodiscard]] MapState lifted(MapState state, const MapProjection& at) const;
  [[nodiscard]] MapProjection project(const JointProblem& problem, double scatter, const Expected& held) const;

  JointMapConfig config_;
  const Cells* cells_;
  MapRows rows_;
  MapState state_;
  double floor_Bq_ = 0.0;               ///< per cell
  std::vector<NodeField> sensitivity_;  ///< per node, of all nodes that hold it together, s; of leaves
  std::vector<double> sensitivity_s_;   ///< the means over them
};

/// What the model's sources give, without background: `held` of JointMap.
[[nodiscard]] Expected sources_only(const JointProblem& problem, JointModel model,
                                    const std::vector<ResponseColumn>& columns);

}  // namespace comptonaut
