// SPDX-License-Identifier: BSD-3-Clause
#include "world/world.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
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

TEST(OctoMapWorld, SurfaceCellsLieOnTheGroundOfTheirColumnsAndOnTheWallsAboveIt) {
  const World world = world_of(random_voxels(5, kHalf), "surface.bt", UnknownSpace::kFree);
  const Cells cells = world.surface_cells({-5, 5, -5, 5}, 0.5);
  std::map<std::pair<int, int>, double> lowest_m;
  int walls = 0;
  for (std::size_t j = 0; j < cells.size(); ++j) {
    const Eigen::Vector3d& p_W = cells.p_W(j);
    const bool first = lowest_m.try_emplace({cells.key(j).x, cells.key(j).y}, p_W.z()).second;
    const double ground_m = *world.ground_height_m(0.5 * (cells.key(j).x + 0.5), 0.5 * (cells.key(j).y + 0.5));
    if (first) {
      EXPECT_EQ(p_W.z(), ground_m) << j;
      EXPECT_EQ(voxel_at(p_W - Eigen::Vector3d(0, 0, 0.1), 0.5), cells.key(j)) << j;
    } else {
      ++walls;
      EXPECT_GT(p_W.z(), ground_m) << j;
      EXPECT_EQ(voxel_at(p_W, 0.5), cells.key(j)) << j;
      EXPECT_EQ(world.at(p_W), Occupancy::kFree) << j;
    }
  }
  EXPECT_GT(lowest_m.size(), 50u);
  EXPECT_GT(walls, 10);
}

TEST(OctoMapWorld, EachFaceOfAHouseAboveTheGroundIsACellOnceAndBothSidesOfAThinWallAre) {
  const World world = World::of_boxes(std::vector<Box>{{{2, 2, 0}, {4, 3, 3}}, {{-2, -3, 0}, {-1.5, 3, 2}}},
                                      {{-6, -6, -1}, {6, 6, 6}}, 0.5);
  const Cells cells = world.surface_cells({-5, 5, -5, 5}, 0.5);
  const int around = 2 * (4 + 2) * 6, thin = 2 * (12 + 1) * 4;  // columns times rows of free voxels beside walls
  EXPECT_EQ(cells.size(), static_cast<std::size_t>(20 * 20 + around + thin));
  for (const Eigen::Vector3d& p_W : {Eigen::Vector3d(-2.01, 0.25, 0.25), Eigen::Vector3d(-1.49, 0.25, 1.75),
                                     Eigen::Vector3d(3.25, 1.99, 2.75), Eigen::Vector3d(4.01, 2.25, 0.25)}) {
    const auto at = cells.find(voxel_at(p_W, 0.5));
    ASSERT_TRUE(at) << p_W.transpose();
    EXPECT_LT((cells.p_W(*at) - p_W).norm(), 1e-9) << cells.p_W(*at).transpose();
  }
  // A slope of a voxel a step has no walls.
  const World slope = World::of_voxels({{-6, -6, -4}, {6, 6, 6}}, 0.5, [](const Eigen::Vector3d& p_W) {
    return p_W.z() < 0.5 * p_W.x() ? Occupancy::kOccupied : Occupancy::kFree;
  });
  EXPECT_EQ(slope.surface_cells({-5, 5, -5, 5}, 0.5).size(), 400u);
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
