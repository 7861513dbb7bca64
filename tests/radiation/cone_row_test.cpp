// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/cone_row.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/random.h"
#include "radiation/sparse_row.h"
#include "radiation/toy_response.h"

namespace comptonaut {
namespace {

Cells hills() {
  std::vector<Cells::Cell> cells;
  for (int y = 0; y < 27; ++y) {
    for (int x = 0; x < 41; ++x) {
      const Eigen::Vector3d p_W(0.5 * x + 0.25, 0.5 * y + 0.25, std::sin(0.3 * x) * std::cos(0.2 * y));
      cells.push_back({.key = voxel_at(p_W, 0.5), .p_W = p_W});
    }
  }
  return {0.5, cells};
}

TEST(CellBlocks, HoldEachCellOnceNearTheirMiddles) {
  for (const Cells& cells : {flat_cells({0, 30, 0, 17}, 0.5), flat_cells({0, 3, 0, 2}, 1.0), hills()}) {
    const CellBlocks blocks(cells);
    ASSERT_EQ(blocks.size, cells.size());
    ASSERT_EQ(blocks.cells.size(), padded(cells.size()));
    EXPECT_EQ(std::set(blocks.cells.begin(), blocks.cells.begin() + cells.size()).size(), cells.size());
    for (std::size_t i = 0; i < blocks.cells.size(); ++i) {
      const std::size_t b = i / kBlock;
      const Eigen::Vector3d offset_W =
          cells.p_W(blocks.cells[i]) - Eigen::Vector3d(blocks.x_m[b], blocks.y_m[b], blocks.z_m[b]);
      EXPECT_LE(offset_W.norm(), blocks.radius_m[b]) << "place " << i;
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(blocks.shapes[blocks.shape[b]].offset_m[axis][i % kBlock], offset_W[axis], 1e-6) << "place " << i;
      }
    }
  }
  const CellBlocks even(flat_cells({0, 20, 0, 20}, 0.5));
  EXPECT_EQ(even.shapes.size(), 1U);
  EXPECT_LT(even.radius_m[0], 1.07F) << "4 x 4 cells of 0.5 m";
}

TEST(CellBlocks, BringValuesThereAndBack) {
  const Cells cells = flat_cells({0, 30, 0, 17}, 0.5);
  const CellBlocks blocks(cells);
  std::vector<double> values(cells.size());
  for (std::size_t j = 0; j < values.size(); ++j) values[j] = static_cast<double>(j) + 0.5;
  std::vector<double> back = blocks.by_cell(blocks.by_block(values));
  back.resize(values.size());
  EXPECT_EQ(back, values);
}

/// Section 5, word for word, with the cut.
double slow_entry(const Eigen::Vector3d& m_W, const MlemConfig& config, const Cone& cone,
                  const Eigen::Quaterniond& q_WD) {
  const Eigen::Vector3d to_cell_W = m_W - cone.p_WS;
  const double d = to_cell_W.norm();
  const double delta = std::acos(to_cell_W.dot(cone.axis_W) / d) - std::acos(cone.cos_beta);
  const double h = std::exp(-0.5 * std::pow(delta / config.cone_sigma_rad, 2));
  if (h < config.core_cut) return 0.0;
  return toy_pair_response(q_WD.conjugate() * to_cell_W) * std::exp(-config.attenuation_per_m * d) / (d * d) * h;
}

void expect_section_5(const Cells& cells, const MlemConfig& config, const Cone& cone, int trial) {
  const Eigen::Quaterniond q_WD(Eigen::AngleAxisd(0.7 * trial, Eigen::Vector3d(0.6, 0.0, 0.8)));
  const CellBlocks blocks(cells);
  SparseRow row;
  fill_cone_row(blocks, toy_pair_lookup, config, cone, q_WD, row);
  const std::vector<double> fast = dense(blocks, row);
  double largest = 0.0;
  for (std::size_t j = 0; j < cells.size(); ++j) {
    largest = std::max(largest, slow_entry(cells.p_W(j), config, cone, q_WD));
  }
  for (std::size_t j = 0; j < cells.size(); ++j) {
    const double slow = slow_entry(cells.p_W(j), config, cone, q_WD);
    ASSERT_NEAR(fast[j], slow, 1e-4 * slow + 1e-7 * largest) << "cell " << j << " trial " << trial;
  }
}

TEST(ConeRow, IsSection5ForConesOfEveryOpening) {
  const Cells flat = flat_cells({0, 30, 0, 17}, 0.5), hilly = hills();
  Random random(5);
  for (int trial = 0; trial < 80; ++trial) {
    const MlemConfig config{.cone_sigma_rad = random.uniform(0.03, trial % 4 == 0 ? 1.5 : 0.4)};
    const double cos_beta = trial < 3 ? trial - 1.0 : random.uniform(-1.0, 1.0);
    const Cone cone{.p_WS = {random.uniform(0, 30), random.uniform(0, 17), 2.0},
                    .axis_W = random.unit_vector(),
                    .cos_beta = cos_beta};
    expect_section_5(trial % 3 == 0 ? hilly : flat, config, cone, trial);
  }
}

TEST(ConeRow, IsFiniteAtTheCellItself) {
  const Cells cells = flat_cells({0, 10, 0, 10}, 0.5);
  const CellBlocks blocks(cells);
  const Cone cone{.p_WS = cells.p_W(47), .axis_W = {0, 0, -1}, .cos_beta = 0.1};
  SparseRow row;
  fill_cone_row(blocks, toy_pair_lookup, {}, cone, Eigen::Quaterniond::Identity(), row);
  for (const double value : dense(blocks, row)) EXPECT_TRUE(std::isfinite(value) && value >= 0.0) << value;
}

TEST(ConeRow, PassesTheGroundByThatTheConeDoesNotReach) {
  const CellBlocks blocks(flat_cells({0, 50, 0, 50}, 0.5));
  const Cone cone{.p_WS = {25, 25, 2}, .axis_W = {0, 0, -1}, .cos_beta = std::cos(0.3)};
  SparseRow row;
  fill_cone_row(blocks, toy_pair_lookup, {.cone_sigma_rad = 0.1}, cone, Eigen::Quaterniond::Identity(), row);
  const double reach_m = 2.0 * std::tan(0.3 + 3.72 * 0.1);                            // a disc of ground below
  const double blocks_of_disc = std::numbers::pi * std::pow(reach_m + 2.9, 2) / 4.0;  // and a block's diagonal around
  EXPECT_LT(static_cast<double>(row.blocks.size()), blocks_of_disc);
}

}  // namespace
}  // namespace comptonaut
