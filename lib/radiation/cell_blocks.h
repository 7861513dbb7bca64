// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/cells.h"
#include "radiation/cell_centres.h"

namespace comptonaut {

/// The cells in blocks of kBlock that lie together, on flat ground 4 x 4: what looks at cells passes whole blocks by.
/// The last block is padded with copies of the last cell.
struct CellBlocks {
  explicit CellBlocks(const Cells& cells);

  /// Where a block's cells lie from its middle.
  struct Shape {
    std::array<std::array<float, kBlock>, 3> offset_m;  ///< x, y, z in W
    bool operator==(const Shape&) const = default;
  };

  std::size_t size = 0;               ///< cells, without the padding
  std::vector<std::uint32_t> cells;   ///< which cell each one is
  std::vector<double> x_m, y_m, z_m;  ///< middle of each block, W
  std::vector<float> radius_m;        ///< of each block: no cell is farther from the middle
  std::vector<std::uint32_t> shape;   ///< of each block, never falling
  std::vector<Shape> shapes;          ///< neighbours of the same shape share it: flat ground has few

  [[nodiscard]] std::size_t blocks() const { return radius_m.size(); }

  /// Values of cells in the order of blocks, and of blocks in the order of cells; the padding is zero.
  [[nodiscard]] std::vector<double> by_block(std::span<const double> by_cell) const;
  [[nodiscard]] std::vector<double> by_cell(std::span<const double> by_block) const;
};

}  // namespace comptonaut
