// SPDX-License-Identifier: BSD-3-Clause
#include "world/world.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "world/voxels.h"

namespace comptonaut {
namespace {

constexpr int kHalf = 10;

bool closed(Occupancy occupancy, UnknownSpace unknown) {
  return occupancy == Occupancy::kOccupied || (occupancy == Occupancy::kUnknown && unknown == UnknownSpace::kClosed);
}

TEST(FlatWorld, IsClosedUpToItsGroundAndFreeAbove) {
  const World world = World::flat(1.5);
  EXPECT_EQ(world.at({3, -4, 1.4}), Occupancy::kOccupied);
  EXPECT_EQ(world.at({3, -4, 1.6}), Occupancy::kFree);
  EXPECT_TRUE(world.closed(Box{{0, 0, 1}, {1, 1, 2}}));
  EXPECT_FALSE(world.closed(Box{{0, 0, 1.6}, {1, 1, 2}}));
  EXPECT_EQ(world.ground_height_m(100, 100), 1.5);
  EXPECT_THROW(World::flat(NAN), std::invalid_argument);
}

TEST(FlatWorld, HasTheCellsOfFlatGround) {
  const Area area{-3, 7, 2, 9};
  const Cells expected = flat_cells(area, 0.5, 1.5);
  const Cells cells = World::flat(1.5).surface_cells(area, 0.5);
  ASSERT_EQ(cells.size(), expected.size());
  for (std::size_t j = 0; j < cells.size(); ++j) {
    EXPECT_EQ(cells.key(j), expected.key(j)) << j;
    EXPECT_EQ(cells.p_W(j), expected.p_W(j)) << j;
  }
  EXPECT_THROW(World::flat().surface_cells(area, 0.0), std::invalid_argument);
}

TEST(OctoMapWorld, KnowsEachVoxelAsItWasWritten) {
  const Voxels voxels = random_voxels(1, kHalf);
  const World world = world_of(voxels, "voxels.bt");
  for (int x = -kHalf - 1; x <= kHalf; ++x) {
    for (int y = -kHalf - 1; y <= kHalf; ++y) {
      for (int z = -kHalf - 1; z <= kHalf; ++z) {
        ASSERT_EQ(world.at(voxels.centre_W({x, y, z})), voxels.at({x, y, z})) << x << ' ' << y << ' ' << z;
      }
    }
  }
  EXPECT_EQ(world.at({1e9, 0, 0}), Occupancy::kUnknown);
  EXPECT_EQ(world.at({0, NAN, 0}), Occupancy::kUnknown);
}

TEST(OctoMapWorld, FindsClosedSpaceInABoxAsALoopOverAllVoxelsDoes) {
  const Voxels voxels = random_voxels(2, kHalf);
  Random random(3);
  int closed_boxes = 0;
  for (const UnknownSpace unknown : {UnknownSpace::kClosed, UnknownSpace::kFree}) {
    const World world = world_of(voxels, "boxes.bt", unknown);
    for (int i = 0; i < 2000; ++i) {
      const auto draw = [&] { return random.uniform(-5, 5); };
      const Eigen::Vector3d corner(draw(), draw(), draw());
      const Box region{corner, corner + Eigen::Vector3d::Constant(random.uniform(0, 2))};
      const VoxelKey from = voxel_at(region.min_W, 0.5), to = voxel_at(region.max_W, 0.5);
      bool expected = false;
      for (int x = from.x; x <= to.x; ++x) {
        for (int y = from.y; y <= to.y; ++y) {
          for (int z = from.z; z <= to.z; ++z) expected = expected || closed(voxels.at({x, y, z}), unknown);
        }
      }
      EXPECT_EQ(world.closed(region), expected) << "box " << i << " at " << corner.transpose();
      closed_boxes += expected;
    }
  }
  EXPECT_GT(closed_boxes, 200);
  EXPECT_LT(closed_boxes, 3800);
}

TEST(OctoMapWorld, GroundIsTheHighestOccupiedVoxelWithFreeSpaceAbove) {
  const Voxels voxels = random_voxels(4, kHalf);
  int found = 0;
  for (const UnknownSpace unknown : {UnknownSpace::kClosed, UnknownSpace::kFree}) {
    const World world = world_of(voxels, "ground.bt", unknown);
    for (int x = -kHalf - 1; x <= kHalf; ++x) {
      for (int y = -kHalf - 1; y <= kHalf; ++y) {
        std::optional<double> expected;
        for (int z = kHalf; z >= -kHalf && !expected; --z) {
          const bool ground =
              voxels.at({x, y, z}) == Occupancy::kOccupied && !closed(voxels.at({x, y, z + 1}), unknown);
          if (ground) expected = 0.5 * (z + 1);
        }
        EXPECT_EQ(world.ground_height_m(0.5 * x + 0.1, 0.5 * y + 0.2), expected) << x << ' ' << y;
        found += expected.has_value();
      }
    }
  }
  EXPECT_GT(found, 200);
}

TEST(OctoMapWorld, SurfaceCellsLieOnTheGroundOfTheirColumns) {
  const World world = world_of(random_voxels(5, kHalf), "surface.bt", UnknownSpace::kFree);
  const Cells cells = world.surface_cells({-5, 5, -5, 5}, 0.5);
  EXPECT_GT(cells.size(), 50u);
  for (std::size_t j = 0; j < cells.size(); ++j) {
    const Eigen::Vector3d& p_W = cells.p_W(j);
    EXPECT_EQ(p_W.z(), world.ground_height_m(p_W.x(), p_W.y())) << j;
    EXPECT_EQ(voxel_at(p_W - Eigen::Vector3d(0, 0, 0.1), 0.5), cells.key(j)) << j;
  }
}

TEST(WorldHash, DependsOnTheTerrainAndNotOnItsFile) {
  Voxels voxels = random_voxels(6, kHalf);
  octomap::OcTree tree = octree_of(voxels);
  tree.write(scratch_file("full.ot").string());
  tree.writeBinaryConst(scratch_file("unpruned.bt").string());
  tree.toMaxLikelihood();
  tree.prune();
  tree.writeBinary(scratch_file("pruned.bt").string());
  const std::uint64_t hash = World::load(scratch_file("full.ot")).hash();
  EXPECT_EQ(World::load(scratch_file("unpruned.bt")).hash(), hash);
  EXPECT_EQ(World::load(scratch_file("pruned.bt")).hash(), hash);

  voxels.known.erase(voxels.known.begin());
  EXPECT_NE(world_of(voxels, "changed.bt").hash(), hash);
  EXPECT_EQ(World::flat(0.5).hash(), World::flat(0.5).hash());
  EXPECT_NE(World::flat(0.5).hash(), World::flat(0.0).hash());
}

}  // namespace
}  // namespace comptonaut
