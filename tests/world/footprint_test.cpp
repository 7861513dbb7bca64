// SPDX-License-Identifier: BSD-3-Clause
#include "world/footprint.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "core/random.h"

namespace comptonaut {
namespace {

constexpr Area kArea{-3, 27, 4, 24};
const Box kExtent{{-8, -1, -1}, {32, 29, 12}};
constexpr double kVoxel_m = 0.5;

/// Occupied up to the height that `at` gives, free above.
World of_heights(const std::function<double(double x_m, double y_m)>& at) {
  return World::of_voxels(kExtent, kVoxel_m, [&](const Eigen::Vector3d& p_W) {
    return p_W.z() < at(p_W.x(), p_W.y()) ? Occupancy::kOccupied : Occupancy::kFree;
  });
}

std::ptrdiff_t times_covered(const std::vector<Area>& areas, double x_m, double y_m) {
  return std::ranges::count_if(areas, [&](const Area& area) { return area.contains(x_m, y_m); });
}

/// What must be covered, asked at the middle of each column.
void expect_covered(const World& world, const std::function<bool(double x_m, double y_m)>& stands) {
  const std::vector<Area> areas = footprint(world, kArea);
  for (double x_m = kArea.x_min_m + 0.5 * kVoxel_m; x_m < kArea.x_max_m; x_m += kVoxel_m) {
    for (double y_m = kArea.y_min_m + 0.5 * kVoxel_m; y_m < kArea.y_max_m; y_m += kVoxel_m) {
      ASSERT_EQ(times_covered(areas, x_m, y_m), stands(x_m, y_m) ? 1 : 0) << x_m << ' ' << y_m;
    }
  }
}

bool within(double x_m, double y_m, const Area& area) { return area.contains(x_m, y_m); }

TEST(Footprint, CoversEachColumnOfABoxOnceAndNothingElse) {
  Random random(5);
  for (int world = 0; world < 10; ++world) {
    std::vector<Box> boxes;
    for (int i = 0; i < 8; ++i) {
      const Eigen::Vector3d corner_W(random.uniform(-6, 26), random.uniform(0, 24), 0.0);
      const Eigen::Vector3d size(random.uniform(0.6, 6), random.uniform(0.6, 6), random.uniform(1.5, 8));
      boxes.push_back({.min_W = corner_W, .max_W = corner_W + size});
    }
    SCOPED_TRACE(world);
    expect_covered(World::of_boxes(boxes, kExtent, kVoxel_m), [&](double x_m, double y_m) {
      const Eigen::Vector3d p_W(x_m, y_m, 1.25);
      return std::ranges::any_of(boxes, [&](const Box& box) { return box.touches({.min_W = p_W, .max_W = p_W}); });
    });
  }
}

TEST(Footprint, OfAHillIsWhatStandsOnIt) {
  const Area house{10, 14, 10, 15};
  const auto hill_m = [](double x_m, double) { return 0.2 * (x_m + 5.0); };
  expect_covered(of_heights(hill_m), [](double, double) { return false; });
  expect_covered(
      of_heights([&](double x_m, double y_m) { return hill_m(x_m, y_m) + (within(x_m, y_m, house) ? 3.0 : 0.0); }),
      [&](double x_m, double y_m) { return within(x_m, y_m, house); });
}

TEST(Footprint, LeavesOutPitsAndWalledYards) {
  const Area pit{0, 5, 6, 9}, wall{10, 18, 10, 18}, yard{11, 17, 11, 17};
  const World world = of_heights([&](double x_m, double y_m) {
    if (within(x_m, y_m, pit)) return -0.9;
    return within(x_m, y_m, wall) && !within(x_m, y_m, yard) ? 3.0 : 1.0;
  });
  expect_covered(world, [&](double x_m, double y_m) { return within(x_m, y_m, wall) && !within(x_m, y_m, yard); });
}

TEST(Footprint, HasTowersThatReachPastTheWorldsTopAndRoofsOverFreeSpace) {
  const std::vector<Box> boxes = {{{0, 8, 0}, {4, 12, 50}}, {{10, 8, 4}, {16, 14, 5}}};
  expect_covered(World::of_boxes(boxes, kExtent, kVoxel_m), [&](double x_m, double y_m) {
    return within(x_m, y_m, {0, 4, 8, 12}) || within(x_m, y_m, {10, 16, 8, 14});
  });
}

TEST(Footprint, IsASingleRectangleOfASingleHouseCutToTheArea) {
  const std::vector<Box> house = {{{20, 20, 0}, {30, 30, 5}}};
  EXPECT_EQ(footprint(World::of_boxes(house, kExtent, kVoxel_m), kArea), (std::vector<Area>{{20, 27, 20, 24}}));
}

TEST(Footprint, OfFlatGroundIsEmptyAndOfWhatAppearedOnItIsThat) {
  EXPECT_TRUE(footprint(World::flat(1.0), kArea).empty());
  std::vector<VoxelChange> changes;
  for (int z = 0; z < 6; ++z) changes.push_back({.voxel = {4, 20, z}, .occupancy = Occupancy::kOccupied});
  EXPECT_EQ(footprint(World::flat().with(changes), kArea), (std::vector<Area>{{2, 2.5, 10, 10.5}}));
}

/// A page must stay small, and a campaign begin soon, however large the area is.
TEST(Footprint, OfALargeAreaIsCoarser) {
  const Area area{0, 1000, 0, 1000};
  std::vector<VoxelChange> hall;
  for (int x = 200; x < 280; ++x) {
    for (int y = 200; y < 243; ++y) {
      for (int z = 0; z < 12; ++z) hall.push_back({.voxel = {x, y, z}, .occupancy = Occupancy::kOccupied});
    }
  }
  EXPECT_EQ(footprint(World::flat().with(hall), area), (std::vector<Area>{{100, 140, 100, 122}}));
}

}  // namespace
}  // namespace comptonaut
