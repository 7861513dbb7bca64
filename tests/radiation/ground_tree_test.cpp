// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/ground_tree.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"

namespace comptonaut {
namespace {

/// Hilly ground with holes, on both sides of the origin; steep places have two cells in a column.
Cells hills(Random& random) {
  std::vector<Cells::Cell> cells;
  for (int x = -37; x < 60; ++x) {
    for (int y = -20; y < 45; ++y) {
      if (random.uniform() < 0.2) continue;
      const int z = static_cast<int>(random.uniform(0, 3));
      for (int k = z; k <= z + (random.uniform() < 0.1 ? 1 : 0); ++k) {
        cells.push_back({.key = {x, y, k}, .p_W = 0.5 * Eigen::Vector3d(x + 0.5, y + 0.5, k + 0.5)});
      }
    }
  }
  return {0.5, std::move(cells)};
}

TEST(GroundTree, SeesEveryCellOnceAndNoNodeWiderThanAllowed) {
  Random random(11);
  const Cells cells = hills(random);
  GroundTree tree(cells);
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::Vector3d p_W(random.uniform(-30, 40), random.uniform(-20, 30), random.uniform(2, 8));
    const double reach_m = random.uniform(0, 1), merge_rad = random.uniform(0.05, 0.5),
                 edge_max_m = std::exp2(random.uniform(-1, 4));
    std::vector<int> times(cells.size(), 0);
    bool several = true;
    for (const std::uint32_t at : tree.seen_from(p_W, reach_m, merge_rad, edge_max_m)) {
      const GroundNode& node = tree.nodes()[at];
      EXPECT_TRUE(several || node.cells == 1) << "those of several cells come first";
      several = node.cells > 1;
      const double edge_m = 0.5 * std::exp2(node.level);
      for (const std::uint32_t j : tree.cells_of(node)) {
        ++times[j];
        const double d_m = (cells.p_W(j) - p_W).norm();
        EXPECT_TRUE(node.cells == 1 || node.level == 0 || edge_m <= merge_rad * (d_m + 2.0 - reach_m))
            << "cell " << j;  // heights differ by 2 m
        EXPECT_TRUE(node.cells == 1 || node.level == 0 || edge_m <= edge_max_m) << "cell " << j;
      }
    }
    for (std::size_t j = 0; j < times.size(); ++j) ASSERT_EQ(times[j], 1) << "cell " << j << " trial " << trial;
  }
}

TEST(GroundTree, KnowsWhereItsNodesLie) {
  Random random(12);
  const Cells cells = hills(random);
  GroundTree tree(cells);
  (void)tree.seen_from({0, 0, 2}, 0.0, 0.2, 1e9);
  for (const GroundNode& node : tree.nodes()) {
    Eigen::Vector3d mean_W = Eigen::Vector3d::Zero();
    for (const std::uint32_t j : tree.cells_of(node)) mean_W += cells.p_W(j) / node.cells;
    EXPECT_LT((mean_W - node.p_W).norm(), 1e-9);
    std::uint32_t below = 0;
    for (std::uint32_t i = 0; i < node.children; ++i) {
      EXPECT_EQ(&tree.nodes()[tree.nodes()[node.child + i].parent], &node);
      below += tree.nodes()[node.child + i].cells;
    }
    EXPECT_TRUE(node.children == 0 || below == node.cells);
  }
}

TEST(GroundTree, IsCoarseWhereNobodyLooks) {
  const Cells small = flat_cells({0, 64, 0, 64}, 0.5), large = flat_cells({-224, 288, -224, 288}, 0.5);
  GroundTree small_tree(small), large_tree(large);
  const auto near = small_tree.seen_from({32, 32, 2}, 0.9, 0.2, 1e9).size();
  const auto far = large_tree.seen_from({32, 32, 2}, 0.9, 0.2, 1e9).size();
  EXPECT_LT(far, near + 3 * 350) << "64 times the cells, three doublings of the distance";
}

TEST(GroundTree, RefusesGroundWithoutCells) { EXPECT_THROW(GroundTree(Cells(0.5, {})), std::invalid_argument); }

}  // namespace
}  // namespace comptonaut
