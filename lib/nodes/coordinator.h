// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/batch_key.h"
#include "core/cells.h"
#include "flight/plan.h"
#include "nodes/coordinator_config.h"
#include "nodes/map_tile.h"
#include "nodes/more_nuclides.h"
#include "nodes/status.h"
#include "nodes/terrain_tile.h"
#include "radiation/measurement_batch.h"
#include "radiation/source_estimate.h"

namespace comptonaut {

class ConeDensity;
class ResponseTable;
class World;

/// Folds the team's measurements into one map of activity, estimates the sources and says who flies where. What range
/// points find changes the terrain: plans, what obstacles let through, and where sources may lie.
///
/// Its state is a function of the bases of its ticks: a second coordinator that follows the bases that the first
/// announced, each in its turn, holds the same map and makes the same plans, bit for bit, in whatever order the
/// batches arrived. No LCM, no threads, no clock of its own.
class Coordinator {
 public:
  /// What is to be sent at one tick.
  struct Tick {
    CoordinatorState state;
    std::vector<Plan> plans;  ///< one per MAV ever seen; none with strategy "none"
    SourceReport sources;
    std::optional<PatchReport> patches;    ///< nullopt: the estimator does not tell
    std::vector<MapTile> map;              ///< the whole map every map_period_s, else empty
    std::vector<ClearanceTile> clearance;  ///< with the map; empty where the estimator does not tell
  };

  /// `cells` is the terrain's surface, `response` the nuclide's table, `world` holds the obstacles.
  /// `cones` is what the estimator "joint" knows of the nuclide's pairs; others need none.
  /// `more` are the tables of config.more_nuclides. Throws std::invalid_argument where there are no cells or no MAVs,
  /// or no cones that are needed.
  Coordinator(const CoordinatorConfig& config, Cells cells, const ResponseTable& response, World world,
              const std::optional<ConeDensity>& cones = std::nullopt, const std::vector<MoreNuclide>& more = {});
  ~Coordinator();
  Coordinator(Coordinator&&) noexcept;
  Coordinator& operator=(Coordinator&&) noexcept;

  /// Keeps a batch until a tick folds it. Refuses, and counts, what is of another mission, of a machine that is not of
  /// the team, not sane (position, time, directions), or given up already. A batch that is known changes nothing.
  void on_measurements(const MeasurementBatch& batch);

  /// Likewise for voxels that range points of a MAV found to be otherwise. A tile whose voxels are not of this map's
  /// edge, or absurdly far away, is counted and folded empty, so that its number is not missed.
  void on_terrain(const TerrainTile& tile);

  /// The next whole second of the team's time (see TeamClock) in which something came, once the batches of every MAV of
  /// the team reach it; else nullopt. To be called until it says so. The first tick waits for all of them to begin. A
  /// gap is given up when the team's time is gap_give_up_s later than what follows the gap, and a MAV that has been
  /// silent so long, or whose clock is so far behind, is not waited for. What it measured is folded when it comes.
  [[nodiscard]] std::optional<Tick> tick_if_complete();

  /// As tick_if_complete, but of several seconds that are complete the last: a daemon whose ticks take longer than a
  /// second would fall behind for ever. The ticks before are left out, no measurement is; such ticks are counted.
  [[nodiscard]] std::optional<Tick> tick_latest_complete();

  /// The next whole second with what is there: for the daemon when its patience has run out. nullopt unless the team's
  /// time reaches that second.
  [[nodiscard]] std::optional<Tick> tick_anyway();

  /// The tick that another coordinator made from `basis`. nullopt, and nothing changed, while batches of the basis are
  /// missing, or where the tick is not later than the last one or the basis goes back behind it.
  [[nodiscard]] std::optional<Tick> follow(Utime tick, const Basis& basis);

  /// Activity of each cell at the last tick, Bq, in the order of the cells, of the first nuclide. With estimator
  /// "joint", what point sources explain is left out.
  [[nodiscard]] std::span<const double> lambda_Bq() const;
  /// s_j, s: of pairs; with estimator "joint" of pairs and singles.
  [[nodiscard]] std::span<const double> sensitivity_s() const;
  /// Of each MAV also how far its clock is ahead of the team's, and the batches that were folded with a strange time:
  /// further from their tick than waiting for a gap explains.
  [[nodiscard]] std::vector<Counter> counters() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace comptonaut
