// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <stdexcept>

namespace comptonaut {
namespace {

TEST(FlatCells, FillTheAreaWithCentresOnTheGround) {
  const Cells cells = flat_cells({0, 50, -10, 60}, 0.5, 1.0);
  EXPECT_EQ(cells.size(), 100u * 140u);
  for (std::size_t j = 0; j < cells.size(); ++j) {
    const Eigen::Vector3d& p_W = cells.p_W(j);
    EXPECT_TRUE(p_W.x() > 0 && p_W.x() < 50 && p_W.y() > -10 && p_W.y() < 60) << p_W.transpose();
    EXPECT_EQ(p_W.z(), 1.0);
    EXPECT_EQ(voxel_at(p_W - Eigen::Vector3d(0, 0, 0.1), 0.5), cells.key(j)) << p_W.transpose();
  }
}

TEST(Cells, FindsEachCellByItsKeyAndNoOther) {
  const Cells cells = flat_cells({0, 5, 0, 4}, 0.5);
  for (std::size_t j = 0; j < cells.size(); ++j) EXPECT_EQ(cells.find(cells.key(j)), j);
  EXPECT_FALSE(cells.find({100, 0, 0}));
  EXPECT_FALSE(cells.find({0, 0, 5}));
}

TEST(Cells, NeighboursAreThoseWhoseVoxelsTouch) {
  std::vector<Cells::Cell> terrain;  // steps of one voxel along x, a wall of three after x = 4
  for (int x = 0; x < 8; ++x) {
    for (int y = 0; y < 3; ++y) {
      const int z = x < 5 ? x / 2 : x / 2 + 3;
      terrain.push_back({.key = {x, y, z}, .p_W = {x + 0.5, y + 0.5, z + 1.0}});
    }
  }
  const Cells cells(1.0, terrain);
  for (std::size_t j = 0; j < cells.size(); ++j) {
    std::set<std::size_t> expected;
    for (std::size_t k = 0; k < cells.size(); ++k) {
      const VoxelKey a = cells.key(j), b = cells.key(k);
      const bool touch = std::abs(a.x - b.x) <= 1 && std::abs(a.y - b.y) <= 1 && std::abs(a.z - b.z) <= 1;
      if (k != j && touch) expected.insert(k);
    }
    const auto found = cells.neighbours(j);
    EXPECT_EQ(std::set<std::size_t>(found.begin(), found.end()), expected) << "cell " << j;
    EXPECT_EQ(found.size(), expected.size()) << "cell " << j;
  }
}

TEST(Cells, RefusesDoubleKeysAndSizesThatAreNotPositive) {
  const Cells::Cell cell{.key = {1, 2, 3}, .p_W = {0, 0, 0}};
  EXPECT_THROW(Cells(1.0, {cell, cell}), std::invalid_argument);
  EXPECT_THROW(Cells(0.0, {cell}), std::invalid_argument);
  EXPECT_THROW(flat_cells({0, 50, 0, 50}, -0.5), std::invalid_argument);
  EXPECT_THROW(flat_cells({0, NAN, 0, 50}, 0.5), std::invalid_argument);
  EXPECT_THROW(flat_cells({0, 0, 0, 50}, 0.5), std::invalid_argument);
  EXPECT_THROW(flat_cells({0, 2e5, 0, 2e5}, 0.05), std::invalid_argument);
}

TEST(Cells, LieWithinTheirBoundingAreaToTheirEdges) {
  EXPECT_EQ(bounding_area(flat_cells({2, 5, -1, 3}, 0.5)), (Area{2, 5, -1, 3}));
  EXPECT_FALSE(bounding_area(Cells(1.0, {})).contains(0.0, 0.0));
}

}  // namespace
}  // namespace comptonaut
