// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/cells.h"
#include "nodes/coordinator_config.h"
#include "nodes/map_tile.h"
#include "nodes/more_nuclides.h"
#include "nodes/status.h"
#include "radiation/joint_estimator.h"
#include "radiation/mlem_estimator.h"
#include "radiation/source_estimate.h"

namespace comptonaut {

/// The coordinator's estimator, whichever the configuration names, and what it says of each cell. With "joint" one per
/// nuclide: what the sources of a higher line leave in a lower channel is part of what that one explains, and tells
/// where they are.
class TeamEstimate {
 public:
  /// `cells` must outlive it. `world` holds the obstacles. Throws std::invalid_argument where the estimator is unknown,
  /// needs cones and has none, or cannot tell nuclides apart ("mlem").
  TeamEstimate(const CoordinatorConfig& config, const Cells& cells, const ResponseTable& response,
               const std::optional<ConeDensity>& cones, const std::vector<MoreNuclide>& more = {},
               const World& world = World::flat());

  void add(const MeasurementBatch& batch);
  void update();

  /// `cells` is otherwise than it was, or `world` holds other obstacles: what depends on them is computed from all
  /// batches again, now or at the next update.
  void set_terrain(const World& world);

  /// One nuclide's map at the last update, per cell.
  struct NuclideMap {
    std::string nuclide;
    std::vector<double> lambda_Bq;      ///< "joint": of what its point sources do not explain
    std::vector<double> sensitivity_s;  ///< s_j: expected events per Bq, s: pairs ("mlem"), pairs and singles ("joint")
  };
  /// The configuration's nuclide first.
  [[nodiscard]] const std::vector<NuclideMap>& maps() const { return maps_; }

  /// What a search is to see: all activity of all nuclides, point sources in their cells, and the sensitivity of pairs
  /// of the first one, whatever the estimator, so that a strategy's thresholds mean the same with each.
  struct Ground {
    std::vector<double> lambda_Bq, pair_sensitivity_s;
  };
  [[nodiscard]] Ground ground() const;
  /// What each nuclide's channel counted beside what it expected; none where the estimator does not tell.
  [[nodiscard]] std::vector<std::vector<Look>> looks() const;

  /// Where points do not explain the data; nullopt: the estimator does not tell. Mission and time as in `report`.
  [[nodiscard]] std::optional<PatchReport> patches() const;
  /// Where the ground is clear; none where the estimator does not tell.
  [[nodiscard]] std::vector<ClearanceTile> clearance() const;

  /// Sources, coverage and certificate; mission and time are left to the caller.
  [[nodiscard]] SourceReport report() const;

  [[nodiscard]] std::int64_t rows() const;  ///< "mlem": cones, "joint": pairs of all nuclides
  [[nodiscard]] std::int64_t viewpoints() const;
  [[nodiscard]] std::vector<Counter> counters() const;

 private:
  /// What the nuclides above one leave in its channel.
  [[nodiscard]] std::vector<KnownSource> known_above(std::size_t nuclide) const;
  /// Places the sources of the nuclides above one where its channel has come to see them.
  void place_above(std::size_t nuclide);
  /// Point sources of a nuclide but for those that a patch stands for.
  [[nodiscard]] std::vector<SourceEstimate> sources(std::size_t nuclide) const;

  CoordinatorConfig config_;
  const Cells& cells_;
  std::optional<ResponseLookup> pair_response_;  ///< "mlem"
  std::optional<MlemEstimator> mlem_;
  std::vector<MeasurementBatch> added_;              ///< "mlem", which keeps no data itself
  std::deque<JointEstimator> joint_;                 ///< by rising line
  std::vector<std::vector<SourceEstimate>> points_;  ///< of each, placed by all channels that see them
  std::vector<NuclideMap> maps_;
  std::int64_t map_steps_ = 0, map_unconverged_ = 0;
};

}  // namespace comptonaut
