// SPDX-License-Identifier: BSD-3-Clause
// Tiles of changed voxels in the books and in the coordinator.
#include "nodes/team_terrain.h"

#include <gtest/gtest.h>

#include "nodes/batch_check.h"
#include "nodes/batch_ledger.h"
#include "nodes/coordinator_fixture.h"

namespace comptonaut {
namespace {

constexpr Occupancy kOccupied = Occupancy::kOccupied, kFree = Occupancy::kFree;

TerrainTile tile(std::int32_t sender, std::int64_t number, Utime utime, std::vector<VoxelChange> voxels) {
  return {.key = {.mission = 5, .sender = sender, .boot_epoch = 100, .number = number},
          .utime = utime,
          .voxel_m = 0.5,
          .voxels = std::move(voxels)};
}

/// A wall across the field, 3 m high, at x from 10 to 10.5.
std::vector<VoxelChange> wall(Occupancy occupancy = kOccupied) {
  std::vector<VoxelChange> voxels;
  for (int y = 4; y < 36; ++y) {
    for (int z = 0; z < 6; ++z) voxels.push_back({{20, y, z}, occupancy});
  }
  return voxels;
}

/// some_mission whose MAV 1 tells of the wall behind batch `after`, in a sequence that goes on.
std::vector<TeamBatch> mission_with_wall(int duration_s, std::int64_t after) {
  std::vector<TeamBatch> sent;
  for (MeasurementBatch batch : some_mission(duration_s)) {
    if (batch.key.sender == 1 && batch.key.number > after) ++batch.key.number;
    sent.push_back(batch);
    if (batch.key.sender == 1 && batch.key.number == after)
      sent.push_back(tile(1, after + 1, batch.end_utime(), wall()));
  }
  return sent;
}

void enter(Coordinator& coordinator, const TeamBatch& batch) {
  if (const auto* terrain = std::get_if<TerrainTile>(&batch)) return coordinator.on_terrain(*terrain);
  coordinator.on_measurements(std::get<MeasurementBatch>(batch));
}

TEST(TeamTerrain, OfTwoThatDisagreeTheLaterTileCounts) {
  const Area area{0, 20, 0, 20};
  TeamTerrain terrain(World::flat(), flat_cells(area, 0.5), area);
  const std::uint64_t flat = terrain.hash();
  EXPECT_TRUE(terrain.fold(std::vector{tile(1, 0, 10, wall()), tile(2, 0, 20, wall(kFree)), tile(3, 0, 20, wall())}));
  EXPECT_EQ(terrain.world().at({10.2, 10.2, 1}), kOccupied);
  EXPECT_NE(terrain.hash(), flat);
  EXPECT_FALSE(terrain.fold(std::vector{tile(1, 1, 30, wall())})) << "nothing new";
  EXPECT_TRUE(terrain.fold(std::vector{tile(2, 1, 40, wall(kFree))}));
  EXPECT_TRUE(terrain.world().is_flat());
  EXPECT_EQ(terrain.hash(), flat);
  EXPECT_FALSE(terrain.fold({}));
}

TEST(BatchLedger, FoldsTilesByTheirNumbersBetweenBatches) {
  BatchLedger ledger(3 * kSecond_us, 3);
  for (const TeamBatch& batch : mission_with_wall(2, 4)) ledger.enter(batch);
  const auto first = ledger.fold_until(kMissionStart + kSecond_us);
  EXPECT_EQ(first.batches.size(), 60u);
  ASSERT_EQ(first.tiles.size(), 1u);
  EXPECT_EQ(first.basis[0].number, 20) << "20 batches and a tile";
  EXPECT_EQ(ledger.reach(1), kMissionStart + 2 * kSecond_us);

  BatchLedger lossy(3 * kSecond_us, 3);
  for (const TeamBatch& batch : mission_with_wall(2, 4)) {
    if (std::holds_alternative<MeasurementBatch>(batch)) lossy.enter(batch);
  }
  EXPECT_EQ(lossy.fold_until(kMissionStart + kSecond_us).batches.size(), 45u) << "a lost tile is a gap like any other";
}

TEST(CoordinatorTerrain, IsTheSameForAFollowerThatFoldsTheSameBases) {
  for (const std::string estimator : {"mlem", "joint"}) {
    CoordinatorConfig config = small_config();
    config.estimator = estimator;
    const std::vector<TeamBatch> sent = mission_with_wall(4, 35);
    Coordinator leader = make_coordinator(config), follower = make_coordinator(config);
    std::vector<Coordinator::Tick> ticks;
    for (const TeamBatch& batch : sent) {
      enter(leader, batch);
      while (auto tick = leader.tick_if_complete()) ticks.push_back(std::move(*tick));
    }
    for (auto batch = sent.rbegin(); batch != sent.rend(); ++batch) enter(follower, *batch);
    ASSERT_EQ(ticks.size(), 4u);
    for (const Coordinator::Tick& tick : ticks) {
      const auto followed = follower.follow(tick.state.utime, tick.state.basis);
      ASSERT_TRUE(followed);
      EXPECT_EQ(followed->state.terrain_hash, tick.state.terrain_hash);
      EXPECT_EQ(followed->state.lambda_hash, tick.state.lambda_hash);
    }
    EXPECT_NE(ticks[3].state.terrain_hash, ticks[0].state.terrain_hash);
    EXPECT_EQ(counter(leader, "voxels_changed"), 192);
    EXPECT_EQ(counter(leader, "terrain_rebuilds"), 1);
  }
}

/// Sensitivity is what would have come out if the wall had been known from the start: it is computed again.
TEST(CoordinatorTerrain, ComputesSensitivityAgainFromTheStoredViewpoints) {
  for (const std::string estimator : {"mlem", "joint"}) {
    CoordinatorConfig config = small_config();
    config.estimator = estimator;
    const World world = World::flat().with(wall());
    Coordinator late = make_coordinator(config);
    Coordinator early(config, world.surface_cells(config.area, config.cell_m), toy_table(), world, some_cones());
    for (const TeamBatch& batch : mission_with_wall(4, 55)) {
      for (Coordinator* coordinator : {&late, &early}) {
        enter(*coordinator, batch);
        while (coordinator->tick_if_complete()) {
        }
      }
    }
    ASSERT_EQ(late.sensitivity_s().size(), early.sensitivity_s().size());
    EXPECT_GT(late.sensitivity_s().size(), 1600u) << "the wall has cells";
    double difference = 0.0, sum = 0.0;
    for (std::size_t j = 0; j < late.sensitivity_s().size(); ++j) {
      difference += std::abs(late.sensitivity_s()[j] - early.sensitivity_s()[j]);
      sum += early.sensitivity_s()[j];
    }
    EXPECT_LT(difference, 1e-3 * sum) << estimator;
  }
}

TEST(CoordinatorTerrain, RefusesAndCountsTilesThatItShouldNotFoldWithoutMissingTheirNumbers) {
  Coordinator coordinator = make_coordinator(small_config());
  TerrainTile foreign = tile(1, 0, kMissionStart, wall());
  foreign.key.mission = 6;
  coordinator.on_terrain(foreign);
  coordinator.on_terrain(tile(9, 0, kMissionStart, wall()));
  coordinator.on_terrain(tile(1, -1, kMissionStart, wall()));
  coordinator.on_terrain(tile(1, 0, -1, wall()));
  EXPECT_EQ(counter(coordinator, "batches_refused_mission"), 1);
  EXPECT_EQ(counter(coordinator, "batches_refused_sender"), 1);
  EXPECT_EQ(counter(coordinator, "batches_refused_content"), 2);
  TerrainTile other_edge = tile(1, 36, kMissionStart, wall());
  other_edge.voxel_m = 0.25;
  for (TeamBatch batch : mission_with_wall(3, 35)) {
    enter(coordinator, std::holds_alternative<TerrainTile>(batch) ? TeamBatch(other_edge) : batch);
    while (coordinator.tick_if_complete()) {
    }
  }
  EXPECT_EQ(counter(coordinator, "ticks"), 3);
  EXPECT_EQ(counter(coordinator, "tiles_refused_voxels"), 1);
  EXPECT_EQ(counter(coordinator, "voxels_changed"), 0);
  EXPECT_EQ(counter(coordinator, "batches_waiting"), 0);
  const Area area{0, 20, 0, 20};
  EXPECT_FALSE(fits_map(tile(1, 0, 1, {{{1'000'000, 0, 0}, kOccupied}}), World::flat(), area)) << "500 km away";
}

}  // namespace
}  // namespace comptonaut
