// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/terrain_mapper.h"

#include <gtest/gtest.h>

#include <cmath>

#include "nodes/mapper_fixture.h"

namespace comptonaut {
namespace {

/// A MAV that stands still at (0, 0, 2), heading north: x_B is y_W.
StampedPose standing_at(Utime utime) { return {.utime = utime, .p_WB = {0.1, 0.1, 2.1}, .q_WB = from_yaw(M_PI / 2)}; }

/// Points ahead on a wall 8 m north, seen from 10 cm before the MAV's middle.
RangePoints wall_at(Utime utime) {
  RangePoints points{.utime = utime, .p_BR = {0.1, 0, 0}, .range_max_m = 20.0, .points_B = {}};
  for (float y = -4.0F; y < 4.0F; y += 0.25F) {
    for (const float z : {0.0F, 1.0F, 2.0F}) points.points_B.emplace_back(8.1F, y, z);
  }
  return points;
}

struct Team {
  Mapper mapper{config(), kFirst};
  std::vector<MeasurementBatch> batches;
  std::vector<TerrainTile> tiles;

  /// Poses at 50 Hz, events, and scans of the wall five times a second.
  void fly(int first_batch, int last_batch, bool sees = true) {
    for (int number = first_batch; number <= last_batch; ++number) {
      const Utime utime = kStart_us + number * kBatch_us;
      if (sees && number % 4 == 0) mapper.on_points(wall_at(utime + 1));
      for (Utime at = utime; at < utime + kBatch_us; at += 10'000) take(mapper.on_pose(standing_at(at)));
      take(mapper.on_events(events(number)));
    }
  }
  void take(std::vector<MeasurementBatch> released) {
    append(batches, std::move(released));
    for (TerrainTile& tile : mapper.take_terrain()) tiles.push_back(std::move(tile));
  }
};

TEST(TerrainMapper, TellsOfTheWallOnceEachSecondInOneSequenceWithTheBatches) {
  Team team;
  team.fly(0, 99);
  ASSERT_GE(team.tiles.size(), 1u);
  std::vector<std::int64_t> numbers;
  for (const auto& batch : team.batches) numbers.push_back(batch.key.number);
  for (const auto& tile : team.tiles) numbers.push_back(tile.key.number);
  std::ranges::sort(numbers);
  for (std::size_t i = 0; i < numbers.size(); ++i) ASSERT_EQ(numbers[i], static_cast<std::int64_t>(i));
  Utime before = 0;
  World world = World::flat();
  for (const TerrainTile& tile : team.tiles) {
    EXPECT_TRUE(before == 0 || tile.utime == before || tile.utime >= before + kSecond_us) << tile.utime;
    before = tile.utime;
    EXPECT_EQ(tile.voxel_m, 0.5);
    EXPECT_LE(tile.voxels.size(), kMaxVoxelsPerTile);
    for (const auto& batch : team.batches) {
      EXPECT_TRUE(batch.key.number != tile.key.number - 1 || batch.end_utime() == tile.utime) << tile.key.number;
    }
    world = world.with(tile.voxels);
  }
  for (double x = -3.5; x < 3.5; x += 0.5) EXPECT_EQ(world.at({x, 8.2, 2.2}), Occupancy::kOccupied) << x;
  EXPECT_EQ(world.at({0.1, 7.2, 2.2}), Occupancy::kFree);
  EXPECT_EQ(counter(team.mapper, "scans"), 25);
  EXPECT_EQ(counter(team.mapper, "points_refused"), 0);
}

TEST(TerrainMapper, FreesWhatTheSensorLooksThroughNotTheMav) {
  const VoxelKey before_sensor{0, 8, 10},
      before_mav{0, 8, 7};  // of the ways to the point from 3 m above the MAV, and from it
  const World map = World::flat().with(
      std::vector<VoxelChange>{{before_sensor, Occupancy::kOccupied}, {before_mav, Occupancy::kOccupied}});
  Team team{.mapper = Mapper(config(), kFirst, map), .batches = {}, .tiles = {}};
  const std::vector<Eigen::Vector3f> points_B(40, {8.1F, 0, 3});
  for (int i = 0; i < 30; ++i) {
    team.mapper.on_points({.utime = kStart_us + 1, .p_BR = {0, 0, 3}, .range_max_m = 20.0, .points_B = points_B});
  }
  team.fly(0, 40, false);
  ASSERT_EQ(team.tiles.size(), 1u);
  const World seen = map.with(team.tiles[0].voxels);
  EXPECT_EQ(seen.at(centre_of(before_sensor, 0.5)), Occupancy::kFree);
  EXPECT_EQ(seen.at(centre_of(before_mav, 0.5)), Occupancy::kOccupied);
}

TEST(TerrainMapper, LeavesOutPointsThatCannotBeAndCountsThem) {
  Team team;
  RangePoints points = wall_at(kStart_us + 1);
  points.points_B = {{NAN, 0, 0}, {INFINITY, 0, 0}, {20.2F, 0, 0}, {8.1F, 0, 0}};
  for (int i = 0; i < 5; ++i) team.mapper.on_points(points);
  team.fly(0, 40, false);
  EXPECT_EQ(counter(team.mapper, "points"), 5);
  EXPECT_EQ(counter(team.mapper, "points_refused"), 15);
  ASSERT_EQ(team.tiles.size(), 1u);
  const std::vector<VoxelChange> one = {{{0, 16, 4}, Occupancy::kOccupied}};
  EXPECT_EQ(team.tiles[0].voxels, one);
}

TEST(TerrainMapper, GivesUpScansWithoutAPose) {
  Team team;
  team.mapper.on_points(wall_at(kStart_us - 5 * kSecond_us));
  team.mapper.on_points(wall_at(kStart_us + 3600 * kSecond_us));
  for (int i = 0; i < 200; ++i) team.mapper.on_points(wall_at(kStart_us - 5 * kSecond_us));
  EXPECT_EQ(counter(team.mapper, "scans_waiting"), 100) << "a sensor without poses does not fill the memory";
  team.fly(0, 60, false);
  EXPECT_EQ(counter(team.mapper, "scans"), 0);
  EXPECT_EQ(counter(team.mapper, "scans_without_pose"), 202);
  EXPECT_TRUE(team.tiles.empty());
}

TEST(TerrainMapper, SendsNoMoreAtOnceThanItMayAndObstaclesFirst) {
  const World unknown = World::of_voxels({{0, 0, 0}, {1, 1, 1}}, 0.5, [](const auto&) { return Occupancy::kUnknown; });
  MapperConfig small = config();
  small.points.tiles_max = 1;
  Team team{.mapper = Mapper(small, kFirst, unknown), .batches = {}, .tiles = {}};
  team.fly(0, 20);
  ASSERT_EQ(team.tiles.size(), 1u);
  EXPECT_EQ(team.tiles[0].voxels.front().occupancy, Occupancy::kOccupied);
  EXPECT_GT(counter(team.mapper, "terrain_voxels_waiting"), 0);
  team.fly(20, 99);
  EXPECT_EQ(counter(team.mapper, "terrain_voxels_waiting"), 0);
}

}  // namespace
}  // namespace comptonaut
