// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>

#include "world/voxels.h"
#include "world/world.h"

namespace comptonaut {
namespace {

constexpr int kHalf = 20;  // more than two bricks to each side

/// The slow way: what lies in the middle of each of many short steps.
double sampled_m(const Voxels& voxels, const Eigen::Vector3d& a_W, const Eigen::Vector3d& b_W, int steps) {
  int occupied = 0;
  for (int i = 0; i < steps; ++i) {
    const Eigen::Vector3d p_W = a_W + (i + 0.5) / steps * (b_W - a_W);
    occupied += voxels.at(voxel_at(p_W, voxels.voxel_m)) == Occupancy::kOccupied ? 1 : 0;
  }
  return occupied * (b_W - a_W).norm() / steps;
}

TEST(Rays, PassAsMuchOccupiedSpaceAsDenseSamplesOfThemSay) {
  constexpr int kSteps = 20'000;
  Random random(7);
  double passed_m = 0.0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Voxels voxels = random_voxels(seed, kHalf);
    const World world = world_of(voxels, "rays.bt");
    for (int i = 0; i < 100; ++i) {
      const double reach_m = i % 3 == 0 ? 30.0 : 0.5 * kHalf;  // from outside, or within
      Eigen::Vector3d a_W, b_W;
      for (int axis = 0; axis < 3; ++axis) {
        a_W[axis] = random.uniform(-reach_m, reach_m);
        b_W[axis] = i % 5 == axis ? a_W[axis] : random.uniform(-reach_m, reach_m);
      }
      const double length_m = (b_W - a_W).norm();
      const double expected_m = sampled_m(voxels, a_W, b_W, kSteps);
      // A step is wrong by at most itself at each face that is crossed.
      EXPECT_NEAR(world.occupied_m(a_W, b_W), expected_m, 130.0 * length_m / kSteps) << "seed " << seed << " ray " << i;
      EXPECT_NEAR(world.occupied_m(b_W, a_W), world.occupied_m(a_W, b_W), 1e-9) << "seed " << seed << " ray " << i;
      const double enough_m = 0.5 * expected_m;
      EXPECT_GE(world.occupied_m(a_W, b_W, enough_m), enough_m - 0.01) << "seed " << seed << " ray " << i;
      passed_m += expected_m;
    }
  }
  EXPECT_GT(passed_m, 100.0);
}

TEST(Rays, FromASurfaceOutwardsPassNothing) {
  const World world = World::of_boxes(std::vector<Box>{{{2, 2, 0}, {4, 4, 3}}}, {{-5, -5, -1}, {10, 10, 6}}, 0.5);
  EXPECT_EQ(world.occupied_m({0.25, 0.25, 0}, {1, 1, 2}), 0.0);     // the ground
  EXPECT_EQ(world.occupied_m({3.25, 3.25, 3}, {-5, 0, 3.5}), 0.0);  // the roof
  EXPECT_EQ(world.occupied_m({2, 3.25, 1.25}, {-5, 3, 1}), 0.0);    // the wall to the west
  EXPECT_EQ(world.occupied_m({4, 3.25, 1.25}, {9, 3, 1}), 0.0);     // the wall to the east
  EXPECT_NEAR(world.occupied_m({1, 3.25, 1.25}, {9, 3.25, 1.25}), 2.0, 1e-12);
  EXPECT_NEAR(world.occupied_m({3.25, 3.25, 5}, {3.25, 3.25, -0.25}), 3.25, 1e-12);
  EXPECT_EQ(world.occupied_m({3, 3, 1}, {3, 3, 1}), 0.0);
}

TEST(FlatWorld, IsPassedBelowItsGroundAlone) {
  const World world = World::flat(1.0);
  EXPECT_EQ(world.occupied_m({0, 0, 1}, {30, 0, 3}), 0.0);
  EXPECT_NEAR(world.occupied_m({0, 0, 0}, {0, 0, 3}), 1.0, 1e-12);
  EXPECT_NEAR(world.occupied_m({0, 0, 2}, {8, 0, -4}), 10.0 * 5.0 / 6.0, 1e-12);
  EXPECT_NEAR(world.occupied_m({0, 0, 0}, {8, 0, 0}), 8.0, 1e-12);
}

TEST(WorldOfBoxes, IsTheSameWhenItWasSavedAndLoaded) {
  const World world = World::of_boxes(std::vector<Box>{{{2, 2, 0}, {4, 4, 3}}}, {{-5, -5, -1}, {10, 10, 6}}, 0.5);
  EXPECT_EQ(world.at({3, 3, 2.9}), Occupancy::kOccupied);
  EXPECT_EQ(world.at({3, 3, 3.1}), Occupancy::kFree);
  EXPECT_EQ(world.at({0, 0, -0.1}), Occupancy::kOccupied);
  EXPECT_EQ(world.at({0, 0, 6.1}), Occupancy::kUnknown);
  EXPECT_EQ(world.ground_height_m(3.1, 2.1), 3.0);
  const std::filesystem::path file = scratch_file("boxes.bt");
  world.save(file);
  EXPECT_EQ(World::load(file).hash(), world.hash());
  EXPECT_THROW(World::flat().save(file), std::logic_error);
  EXPECT_THROW(world.save("/nowhere/boxes.bt"), std::runtime_error);
}

TEST(WorldOfBoxes, RefusesWhatIsNoMap) {
  const std::vector<Box> none;
  EXPECT_THROW((void)World::of_boxes(none, {{0, 0, 0}, {0, 1, 1}}, 0.5), std::invalid_argument);
  EXPECT_THROW((void)World::of_boxes(none, {{0, 0, 0}, {1, 1, 1}}, 0.0), std::invalid_argument);
  EXPECT_THROW((void)World::of_boxes(none, {{0, 0, 0}, {900, 900, 90}}, 0.5), std::invalid_argument);
  EXPECT_THROW((void)World::of_boxes(none, {{0, 0, 0}, {1e6, 1, 1}}, 0.5), std::invalid_argument);
}

}  // namespace
}  // namespace comptonaut
