// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/cells.h"
#include "radiation/cell_blocks.h"
#include "radiation/cell_centres.h"
#include "radiation/measurement_batch.h"
#include "radiation/mlem_config.h"
#include "radiation/sight_lines.h"
#include "radiation/source_estimate.h"
#include "radiation/system_rows.h"
#include "radiation/view.h"

namespace comptonaut {

/// The published estimator of one nuclide's activity: pairs only, one row per cone [Werner 2024].
/// Its state is a function of the batches in the order of their adding and of when it was updated.
class MlemEstimator {
 public:
  /// `pair_response` is the nuclide's table of pairs. `world` holds obstacles of attenuation obstacles_per_m.
  MlemEstimator(const MlemConfig& config, const Cells& cells, std::string nuclide, ResponseLookup pair_response,
                const World& world = World::flat(), double obstacles_per_m = 0.0);

  /// The batch's live time adds to the sensitivity, each of its cones of this nuclide is a row.
  void add(const MeasurementBatch& batch);

  /// Estimates lambda anew, from a uniform start.
  void update();

  /// Of the last update, Bq; all zeros before the first.
  [[nodiscard]] std::span<const double> lambda_Bq() const { return {lambda_Bq_.data(), cells_.size}; }
  /// Share of the expected events that the last iteration moved from cell to cell; NaN before the first update, and of
  /// one iteration alone.
  [[nodiscard]] double change() const { return change_; }
  /// s_j of pairs, s.
  [[nodiscard]] std::span<const double> sensitivity_s() const { return {sensitivity_s_.data(), cells_.size}; }
  [[nodiscard]] std::int64_t rows() const { return static_cast<std::int64_t>(rows_.size()); }
  [[nodiscard]] std::int64_t viewpoints() const { return viewpoints_; }
  /// Cones that no cell is near enough to have caused.
  [[nodiscard]] std::int64_t cones_outside() const { return cones_outside_; }

 private:
  /// Per cell, as seen from an eye; empty: all.
  [[nodiscard]] std::span<const float> let_through(const Eigen::Vector3d& eye_W);

  MlemConfig config_;
  CellCentres cells_;
  CellBlocks blocks_;
  std::vector<Eigen::Vector3d> places_W_;  ///< of the cells, where there are obstacles
  std::optional<BlockSight> sight_;
  std::string nuclide_;
  ResponseLookup pair_response_;
  SystemRows rows_;
  std::vector<double> sensitivity_s_, lambda_Bq_;  ///< padded
  SparseRow row_;                                  ///< scratch
  double change_ = SourceEstimate::kUnknown;
  std::int64_t viewpoints_ = 0;
  std::int64_t cones_outside_ = 0;
};

}  // namespace comptonaut
