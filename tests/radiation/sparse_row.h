// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <span>
#include <vector>

#include "radiation/cell_blocks.h"
#include "radiation/packed_rows.h"

namespace comptonaut {

/// A row given by all its cells, whole blocks.
inline SparseRow sparse(std::span<const float> dense) {
  SparseRow row;
  for (std::size_t at = 0; at < dense.size(); at += kBlock) {
    const std::span<const float> block = dense.subspan(at, kBlock);
    if (std::all_of(block.begin(), block.end(), [](float value) { return value == 0.0F; })) continue;
    row.blocks.push_back(static_cast<std::uint32_t>(at / kBlock));
    row.values.insert(row.values.end(), block.begin(), block.end());
  }
  return row;
}

/// Rows are stored over their largest value: where that is 1, as they are.
inline void with_largest_one(std::span<float> row) {
  const auto largest = std::max_element(row.begin(), row.end());
  if (*largest > 0.0F) *largest = 1.0F;
}

/// The other way: by cell.
inline std::vector<double> dense(const CellBlocks& cells, const SparseRow& row) {
  std::vector<double> by_block(cells.cells.size(), 0.0);
  for (std::size_t k = 0; k < row.blocks.size(); ++k) {
    std::copy_n(&row.values[k * kBlock], kBlock, &by_block[row.blocks[k] * kBlock]);
  }
  for (std::size_t i = cells.size; i < by_block.size(); ++i) EXPECT_EQ(by_block[i], 0.0) << "padding " << i;
  return cells.by_cell(by_block);
}

}  // namespace comptonaut
