// SPDX-License-Identifier: BSD-3-Clause
#include "world/voxel_evidence.h"

#include <gtest/gtest.h>

#include <numbers>

#include "core/random.h"

namespace comptonaut {
namespace {

constexpr Occupancy kFree = Occupancy::kFree, kOccupied = Occupancy::kOccupied;
constexpr std::size_t kAll = 1'000'000;
const Box kExtent{{-20, -20, -1}, {20, 20, 10}};

World with_wall() { return World::of_boxes(std::vector<Box>{{{6, -5, 0}, {6.5, 5, 4}}}, kExtent, 0.5); }
World without_wall() { return World::of_boxes({}, kExtent, 0.5); }

/// What a sensor that turns evenly sees of `truth`, believed to stand where a tilt by `tilt_rad` about y puts it.
std::vector<Eigen::Vector3d> scan(const World& truth, const Eigen::Vector3d& origin_W, Random& random,
                                  double tilt_rad = 0.0) {
  const Eigen::AngleAxisd tilt(tilt_rad, Eigen::Vector3d::UnitY());
  std::vector<Eigen::Vector3d> points_W;
  for (int i = 0; i < 1000; ++i) {
    const double elevation_rad = random.uniform(-0.7, 0.5), azimuth_rad = random.uniform(0.0, 2 * std::numbers::pi);
    const Eigen::Vector3d ray_W(std::cos(elevation_rad) * std::cos(azimuth_rad),
                                std::cos(elevation_rad) * std::sin(azimuth_rad), std::sin(elevation_rad));
    if (const auto range_m = truth.range_m(origin_W, ray_W, 15.0)) {
      points_W.emplace_back(origin_W + tilt * Eigen::Vector3d(*range_m * ray_W));
    }
  }
  return points_W;
}

World after(const World& start, VoxelEvidence& evidence) { return start.with(evidence.take_changes(kAll)); }

TEST(VoxelEvidence, FindsTheWallThatTheMapDoesNotHoldAndNothingElse) {
  const World truth = with_wall();
  for (const World& start : {without_wall(), World::flat()}) {
    VoxelEvidence evidence(start, {});
    Random random(1);
    for (int i = 0; i < 10; ++i) {
      const Eigen::Vector3d origin_W(-1.0 + 0.2 * i, 0.3, 2.0);
      evidence.insert(origin_W, scan(truth, origin_W, random));
    }
    const World found = after(start, evidence);
    int seen = 0;
    for (double x = -9.75; x < 10; x += 0.5) {
      for (double y = -4.75; y < 5; y += 0.5) {
        for (double z = 0.25; z < 4; z += 0.5) {
          const bool wall = found.at({x, y, z}) == kOccupied;
          EXPECT_TRUE(!wall || (x > 5.4 && x < 6.6)) << x << ' ' << y << ' ' << z;
          seen += wall ? 1 : 0;
        }
      }
    }
    EXPECT_GT(seen, 60) << "of 160";
    EXPECT_TRUE(found.closed(Box{{5.5, -2, 1.5}, {6.5, 2, 2.5}}));
  }
}

TEST(VoxelEvidence, ClearsTheWallThatIsNotThere) {
  const World truth = without_wall();
  VoxelEvidence evidence(with_wall(), {});
  Random random(2);
  for (int i = 0; i < 30; ++i) evidence.insert({0, 0.2, 2}, scan(truth, {0, 0.2, 2}, random));
  const World found = after(with_wall(), evidence);
  for (double y = -1.75; y < 2; y += 0.5) EXPECT_EQ(found.at({6.25, y, 0.75}), kFree) << y;
}

TEST(VoxelEvidence, LeavesAKnownWorldAsItIsWhenPosesTilt) {
  const World truth = with_wall();
  VoxelEvidence evidence(truth, {});
  Random random(3);
  for (int i = 0; i < 60; ++i) {
    const Eigen::Vector3d origin_W(-2.0 + 0.1 * i, 0.3, 2.0);
    const double tilt_rad = 0.017 * (i % 12 < 6 ? 1.0 : -1.0);
    evidence.insert(origin_W, scan(truth, origin_W, random, tilt_rad));
  }
  const World found = after(truth, evidence);
  int raised = 0;
  for (double x = -4.75; x < 5; x += 0.5) {
    for (double y = -4.75; y < 5; y += 0.5) raised += found.ground_height_m(x, y) != 0.0 ? 1 : 0;
  }
  EXPECT_EQ(raised, 0) << "of 400 columns";
}

TEST(VoxelEvidence, NeedsThreeScansToBelieveAPointInFreeSpaceAndTakesEachChangeOnce) {
  VoxelEvidence evidence(without_wall(), {});
  const std::vector<Eigen::Vector3d> points_W(50, Eigen::Vector3d(4.2, 0.2, 3.2));
  for (int i = 0; i < 2; ++i) evidence.insert({0, 0, 3}, points_W);
  EXPECT_EQ(evidence.changes(), 0u) << "a scan counts a voxel once";
  evidence.insert({0, 0, 3}, points_W);
  const std::vector<VoxelChange> wall = {{{8, 0, 6}, kOccupied}};
  EXPECT_EQ(evidence.take_changes(kAll), wall);
  EXPECT_EQ(evidence.take_changes(kAll).size(), 0u);
  const std::vector<Eigen::Vector3d> beyond_W = {{9.2, 0.45, 3.45}};
  for (int i = 0; i < 9; ++i) evidence.insert({0, 0, 3}, beyond_W);
  const std::vector<VoxelChange> gone = {{{8, 0, 6}, kFree}};
  std::vector<VoxelChange> changes = evidence.take_changes(kAll);
  EXPECT_TRUE(std::ranges::find(changes, gone[0]) != changes.end());
}

TEST(VoxelEvidence, OfPointsBeyondItsRangeSaysOnlyThatTheWayIsFree) {
  const World nothing = World::of_voxels({{0, 0, 0}, {1, 1, 1}}, 0.5, [](const auto&) { return Occupancy::kUnknown; });
  VoxelEvidence evidence(nothing, {.range_max_m = 5.0});
  evidence.insert({0.1, 0.1, 0.1}, std::vector<Eigen::Vector3d>{{8.1, 0.1, 0.1}});
  EXPECT_EQ(evidence.at({4.6, 0.1, 0.1}), kFree);
  EXPECT_EQ(evidence.at({5.6, 0.1, 0.1}), Occupancy::kUnknown);
  EXPECT_EQ(evidence.at({8.1, 0.1, 0.1}), Occupancy::kUnknown);
  evidence.insert({0.1, 0.1, 0.1}, std::vector<Eigen::Vector3d>{{0.1, 4.1, 0.1}});
  EXPECT_EQ(evidence.at({0.1, 4.1, 0.1}), kOccupied) << "of unknown space one point is enough";
  const auto first = evidence.take_changes(1);
  ASSERT_EQ(first.size(), 1u);
  EXPECT_EQ(first[0].occupancy, kOccupied) << "occupied ones come first";
  evidence.insert({1e6, 0, 0}, std::vector<Eigen::Vector3d>{{1e6, 3, 0}});  // beyond what voxels reach
}

}  // namespace
}  // namespace comptonaut
