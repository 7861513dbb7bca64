// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "world/voxels.h"
#include "world/world.h"

namespace comptonaut {
namespace {

constexpr int kHalf = 10;
constexpr Occupancy kAll[] = {Occupancy::kFree, Occupancy::kOccupied, Occupancy::kUnknown};

/// Changes of different voxels.
std::vector<VoxelChange> random_changes(std::uint64_t seed, int count) {
  Random random(seed);
  std::map<VoxelKey, Occupancy> changes;
  const auto draw = [&] { return static_cast<int>(random() % (2 * kHalf)) - kHalf; };
  while (std::ssize(changes) < count) changes[{draw(), draw(), draw()}] = kAll[random() % 3];
  std::vector<VoxelChange> list;
  for (const auto& [voxel, occupancy] : changes) list.push_back({voxel, occupancy});
  return list;
}

TEST(ChangedWorld, IsAsTheChangesSayAndAsBeforeElsewhere) {
  Voxels voxels = random_voxels(11, kHalf);
  const World before = world_of(voxels, "before.bt");
  const std::vector<VoxelChange> changes = random_changes(12, 500);
  const World after = before.with(changes);
  Voxels expected = voxels;
  for (const auto& [voxel, occupancy] : changes) {
    if (occupancy == Occupancy::kUnknown)
      expected.known.erase(voxel);
    else
      expected.known[voxel] = occupancy;
  }
  for (int x = -kHalf - 1; x <= kHalf; ++x) {
    for (int y = -kHalf - 1; y <= kHalf; ++y) {
      for (int z = -kHalf - 1; z <= kHalf; ++z) {
        const Eigen::Vector3d p_W = voxels.centre_W({x, y, z});
        ASSERT_EQ(after.at(p_W), expected.at({x, y, z})) << x << ' ' << y << ' ' << z;
        ASSERT_EQ(before.at(p_W), voxels.at({x, y, z})) << x << ' ' << y << ' ' << z;
      }
    }
  }
  EXPECT_EQ(after.hash(), world_of(expected, "after.bt").hash()) << "as if it had been read so";
  EXPECT_NE(after.hash(), before.hash());
}

TEST(ChangedWorld, DoesNotDependOnTheOrderOfIndependentChangesNorOnHowTheyAreCut) {
  const World before = world_of(random_voxels(13, kHalf), "order.bt");
  std::vector<VoxelChange> changes = random_changes(14, 300);
  const std::uint64_t hash = before.with(changes).hash();
  std::ranges::reverse(changes);
  EXPECT_EQ(before.with(changes).hash(), hash);
  const std::span all(changes);
  EXPECT_EQ(before.with(all.first(100)).with(all.subspan(100)).hash(), hash);
  EXPECT_EQ(before.with({}).hash(), before.hash());
  const std::vector<VoxelChange> twice = {{{0, 0, 0}, Occupancy::kOccupied}, {{0, 0, 0}, Occupancy::kFree}};
  EXPECT_EQ(before.with(twice).at({0.1, 0.1, 0.1}), Occupancy::kFree) << "the last one counts";
}

TEST(ChangedWorld, IsUnknownWhereAllIsForgotten) {
  const VoxelChange some{{1, 2, 3}, Occupancy::kOccupied}, none{{1, 2, 3}, Occupancy::kUnknown};
  const World empty = world_of(Voxels{}, "empty.bt");
  const World one = empty.with(std::vector{some});
  EXPECT_EQ(one.at({0.6, 1.1, 1.6}), Occupancy::kOccupied);
  EXPECT_EQ(one.at({0.4, 1.1, 1.6}), Occupancy::kUnknown);
  EXPECT_EQ(one.with(std::vector{none}).at({0.6, 1.1, 1.6}), Occupancy::kUnknown);
  EXPECT_EQ(one.with(std::vector{none}).hash(), empty.hash());
}

TEST(ChangedWorld, RefusesVoxelsThatNoMapReaches) {
  EXPECT_THROW((void)World::flat().with(std::vector<VoxelChange>{{{40'000, 0, 0}, Occupancy::kFree}}),
               std::invalid_argument);
  EXPECT_THROW((void)World::flat(0.0, 0.0), std::invalid_argument);
}

/// Flat ground with voxels that are otherwise, the slow way.
struct FlatVoxels {
  double ground_z_m;
  Voxels voxels;

  [[nodiscard]] Occupancy at(const Eigen::Vector3d& p_W) const {
    const auto known = voxels.known.find(voxel_at(p_W, voxels.voxel_m));
    if (known != voxels.known.end()) return known->second;
    return p_W.z() <= ground_z_m ? Occupancy::kOccupied : Occupancy::kFree;
  }
};

FlatVoxels flat_voxels(double ground_z_m, const std::vector<VoxelChange>& changes) {
  FlatVoxels flat{.ground_z_m = ground_z_m, .voxels = {}};
  for (const auto& [voxel, occupancy] : changes) {
    if (occupancy != Occupancy::kUnknown) flat.voxels.known[voxel] = occupancy;
  }
  return flat;
}

TEST(FlatGroundWithVoxels, IsFlatGroundBetweenThem) {
  Random random(15);
  for (const double ground_z_m : {0.0, 0.7, -1.5}) {
    const std::vector<VoxelChange> changes = random_changes(16, 800);
    const FlatVoxels expected = flat_voxels(ground_z_m, changes);
    const World world = World::flat(ground_z_m).with(changes);
    EXPECT_FALSE(world.is_flat());
    EXPECT_EQ(world.voxel_m(), 0.5);
    const auto draw = [&](double reach_m) {
      return Eigen::Vector3d(random.uniform(-reach_m, reach_m), random.uniform(-reach_m, reach_m),
                             random.uniform(-reach_m, reach_m));
    };
    for (int i = 0; i < 5000; ++i) {
      const Eigen::Vector3d p_W = draw(7);
      ASSERT_EQ(world.at(p_W), expected.at(p_W)) << p_W.transpose();
      ASSERT_EQ(world.closed(p_W), expected.at(p_W) == Occupancy::kOccupied) << p_W.transpose();
      // A box that lies within one voxel and to one side of the ground is closed where its middle is.
      const Eigen::Vector3d half_m = Eigen::Vector3d::Constant(1e-6);
      ASSERT_EQ(world.closed(Box{p_W - half_m, p_W + half_m}), world.closed(p_W)) << p_W.transpose();
    }
    for (int i = 0; i < 200; ++i) {
      constexpr int kSteps = 20'000;
      const Eigen::Vector3d a_W = draw(8), b_W = draw(8);
      int occupied = 0;
      for (int k = 0; k < kSteps; ++k) {
        occupied += expected.at(a_W + (k + 0.5) / kSteps * (b_W - a_W)) == Occupancy::kOccupied ? 1 : 0;
      }
      const double length_m = (b_W - a_W).norm();
      EXPECT_NEAR(world.occupied_m(a_W, b_W), occupied * length_m / kSteps, 100.0 * length_m / kSteps) << "ray " << i;
    }
  }
}

TEST(FlatGroundWithVoxels, HasTheGroundOfItsHighestVoxelWithFreeSpaceAbove) {
  const std::vector<VoxelChange> changes = {{{2, 2, 1}, Occupancy::kOccupied},  // hangs
                                            {{4, 4, 0}, Occupancy::kOccupied},  // on the ground at 0.7
                                            {{6, 6, 1}, Occupancy::kFree},      // a dent down to 0.5
                                            {{8, 8, -1}, Occupancy::kFree}};    // under the ground
  const World world = World::flat(0.7).with(changes);
  EXPECT_EQ(world.ground_height_m(1.1, 1.1), 1.0);
  EXPECT_EQ(world.ground_height_m(2.1, 2.1), 0.7);
  EXPECT_EQ(world.ground_height_m(3.1, 3.1), 0.5);
  EXPECT_EQ(world.ground_height_m(4.1, 4.1), 0.7);
  EXPECT_EQ(world.ground_height_m(50, -70), 0.7);
  EXPECT_EQ(world.ground_height_m(5e4, -7e4), 0.7) << "beyond what voxels reach";
  EXPECT_TRUE(world.surface_cells({0, 10, 0, 10}, 0.5).find({2, 2, 1}));
}

TEST(FlatGroundWithVoxels, IsFlatAgainWhenAllAreAsTheGroundHasThem) {
  const World flat = World::flat(0.0);
  const std::vector<VoxelChange> wall = {{{3, 3, 0}, Occupancy::kOccupied}, {{3, 3, -1}, Occupancy::kFree}};
  const std::vector<VoxelChange> undone = {{{3, 3, 0}, Occupancy::kFree}, {{3, 3, -1}, Occupancy::kUnknown}};
  const World changed = flat.with(wall);
  EXPECT_NE(changed.hash(), flat.hash());
  EXPECT_TRUE(changed.with(undone).is_flat());
  EXPECT_EQ(changed.with(undone).hash(), flat.hash());
  EXPECT_TRUE(flat.with(undone).is_flat());
  EXPECT_NE(changed.hash(), World::flat(0.25).with(wall).hash());
}

TEST(RangeOfARay, IsWhereItBeginsToPassOccupiedSpace) {
  Random random(17);
  const World voxels = world_of(random_voxels(18, kHalf), "range.bt", UnknownSpace::kFree);
  const World house = World::of_boxes(std::vector<Box>{{{2, 2, 0}, {4, 4, 3}}}, {{-5, -5, -1}, {10, 10, 6}}, 0.5);
  const World flat = World::flat(0.3), wall = flat.with(std::vector<VoxelChange>{{{3, 3, 3}, Occupancy::kOccupied}});
  int hits = 0;
  for (const World& world : {voxels, house, flat, wall}) {
    for (int i = 0; i < 300; ++i) {
      const Eigen::Vector3d p_W(random.uniform(-4, 4), random.uniform(-4, 4), random.uniform(0.5, 4));
      const Eigen::Vector3d way_W = 12.0 * random.unit_vector();
      const auto range_m = world.range_m(p_W, way_W, 12.0);
      if (world.at(p_W) == Occupancy::kOccupied) {
        EXPECT_EQ(range_m, 0.0) << i;
        continue;
      }
      hits += range_m ? 1 : 0;
      constexpr double kNear = 2e-3;  // a ray that grazes an edge by less than a float's rounding may miss it
      const double before_m = range_m.value_or(12.0) - kNear;
      EXPECT_LT(world.occupied_m(p_W, p_W + before_m / 12.0 * way_W), kNear) << i;
      if (range_m && *range_m < 11.0) {
        EXPECT_GT(world.occupied_m(p_W, p_W + (*range_m + 1.0) / 12.0 * way_W), 0.0) << i;
      }
    }
  }
  EXPECT_GT(hits, 300);
}

}  // namespace
}  // namespace comptonaut
