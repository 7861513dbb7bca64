// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/cells.h"
#include "nodes/coordinator_config.h"
#include "nodes/map_tile.h"
#include "nodes/status.h"
#include "radiation/joint_estimator.h"
#include "radiation/mlem_estimator.h"
#include "radiation/source_estimate.h"

namespace comptonaut {

/// The coordinator's estimator, whichever the configuration names, and what it says of each cell.
class TeamEstimate {
 public:
  /// `cells` must outlive it. Throws std::invalid_argument where the estimator is unknown, or needs cones and has none.
  TeamEstimate(const CoordinatorConfig& config, const Cells& cells, const ResponseTable& response,
               const std::optional<ConeDensity>& cones);

  void add(const MeasurementBatch& batch);
  void update();

  /// Of the last update, Bq. "joint": of what its point sources do not explain.
  [[nodiscard]] std::span<const double> lambda_Bq() const;
  /// s_j: expected events per Bq, s; of pairs with "mlem", of pairs and singles with "joint".
  [[nodiscard]] std::span<const double> sensitivity_s() const;

  /// What a search is to see: all activity, point sources in their cells, and the sensitivity of pairs, whatever the
  /// estimator, so that a strategy's thresholds mean the same with each.
  struct Ground {
    std::vector<double> lambda_Bq, pair_sensitivity_s;
  };
  [[nodiscard]] Ground ground() const;

  /// Where points do not explain the data; nullopt: the estimator does not tell. Mission and time as in `report`.
  [[nodiscard]] std::optional<PatchReport> patches() const;
  /// Where the ground is clear; none where the estimator does not tell.
  [[nodiscard]] std::vector<ClearanceTile> clearance() const;

  /// Sources, coverage and certificate; mission and time are left to the caller.
  [[nodiscard]] SourceReport report() const;

  [[nodiscard]] std::int64_t rows() const;  ///< "mlem": cones, "joint": pairs
  [[nodiscard]] std::int64_t viewpoints() const;
  [[nodiscard]] std::vector<Counter> counters() const;

 private:
  CoordinatorConfig config_;
  const Cells& cells_;
  std::optional<MlemEstimator> mlem_;
  std::optional<JointEstimator> joint_;
  std::vector<double> lambda_Bq_, sensitivity_s_;  ///< of the joint map
  std::int64_t map_steps_ = 0, map_unconverged_ = 0;
};

}  // namespace comptonaut
