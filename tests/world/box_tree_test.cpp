// SPDX-License-Identifier: BSD-3-Clause
#include "world/box_tree.h"

#include <gtest/gtest.h>

#include <map>

#include "core/random.h"

namespace comptonaut {
namespace {

/// How many boxes hold each voxel.
std::map<std::array<int, 3>, int> voxels_of(const std::vector<VoxelBox>& boxes) {
  std::map<std::array<int, 3>, int> voxels;
  for (const auto& [low, high] : boxes) {
    for (int x = low[0]; x < high[0]; ++x) {
      for (int y = low[1]; y < high[1]; ++y) {
        for (int z = low[2]; z < high[2]; ++z) ++voxels[{x, y, z}];
      }
    }
  }
  return voxels;
}

std::vector<VoxelBox> singles(const std::map<std::array<int, 3>, int>& voxels) {
  std::vector<VoxelBox> boxes;
  for (const auto& [at, count] : voxels) boxes.push_back({.low = at, .high = {at[0] + 1, at[1] + 1, at[2] + 1}});
  return boxes;
}

TEST(MergedBoxes, HoldTheSameVoxelsOnceEach) {
  Random random(3);
  std::map<std::array<int, 3>, int> voxels;
  for (int i = 0; i < 2000; ++i) {
    const auto draw = [&] { return static_cast<int>(random() % 16) - 8; };
    voxels[{draw(), draw(), draw()}] = 1;
  }
  EXPECT_EQ(voxels_of(merged(singles(voxels))), voxels);
  EXPECT_LT(merged(singles(voxels)).size(), voxels.size());
}

TEST(MergedBoxes, OfAHouseOnItsGroundAreTwo) {
  const std::vector<VoxelBox> town = {{.low = {-20, -20, -2}, .high = {20, 20, 0}},
                                      {.low = {3, -5, 0}, .high = {11, 6, 7}}};
  EXPECT_EQ(merged(singles(voxels_of(town))).size(), 2u);
}

/// Of one box after the other.
double slowly_m(double voxel_m, const std::vector<VoxelBox>& boxes, const Eigen::Vector3d& a_W,
                const Eigen::Vector3d& b_W) {
  double sum_m = 0.0;
  for (const VoxelBox& box : boxes) {
    double begin = 0.0, end = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double way_m = b_W[axis] - a_W[axis];
      const double low_m = voxel_m * box.low[axis] - a_W[axis], high_m = voxel_m * box.high[axis] - a_W[axis];
      if (way_m == 0.0) {
        if (low_m > 0.0 || high_m <= 0.0) end = 0.0;
        continue;
      }
      begin = std::max(begin, std::min(low_m / way_m, high_m / way_m));
      end = std::min(end, std::max(low_m / way_m, high_m / way_m));
    }
    sum_m += std::max(0.0, end - begin) * (b_W - a_W).norm();
  }
  return sum_m;
}

/// Of 1 box, of a whole eight, of one more, of several levels, each with ways along axes and faces.
TEST(BoxTree, TellsTheLengthInEachNumberOfBoxes) {
  constexpr double kVoxel_m = 0.5;
  Random random(9);
  for (const std::size_t number : {1, 8, 9, 64, 65, 600}) {
    std::vector<VoxelBox> boxes;
    for (std::size_t i = 0; i < number; ++i) {  // in cells of their own
      const int x = 4 * static_cast<int>(i % 10), y = 4 * static_cast<int>(i / 10 % 10),
                z = 4 * static_cast<int>(i / 100);
      const auto size = [&] { return 1 + static_cast<int>(random() % 4); };
      boxes.push_back({.low = {x, y, z}, .high = {x + size(), y + size(), z + size()}});
    }
    const BoxTree tree(kVoxel_m, boxes);
    for (int i = 0; i < 300; ++i) {
      Eigen::Vector3d a_W, b_W;
      for (int axis = 0; axis < 3; ++axis) {
        a_W[axis] = i % 2 == 0 ? random.uniform(-5.0, 25.0) : kVoxel_m * static_cast<double>(random() % 44);
        b_W[axis] = i % 5 == axis ? a_W[axis] : random.uniform(-5.0, 25.0);
      }
      const double expected_m = slowly_m(kVoxel_m, boxes, a_W, b_W);
      EXPECT_NEAR(tree.length_m(a_W, b_W), expected_m, 1e-9) << number << " boxes, way " << i;
      EXPECT_GE(tree.length_m(a_W, b_W, 0.5 * expected_m), 0.5 * expected_m) << number << " boxes, way " << i;
    }
  }
}

}  // namespace
}  // namespace comptonaut
