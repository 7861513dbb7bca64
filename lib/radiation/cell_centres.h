// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "core/cells.h"

namespace comptonaut {

/// Cells are worked on in blocks of so many, so that no loop has a tail.
inline constexpr std::size_t kBlock = 16;

[[nodiscard]] constexpr std::size_t padded(std::size_t cells) { return (cells + kBlock - 1) / kBlock * kBlock; }

/// The centres of cells as arrays, frame W, padded to whole blocks with copies of the last one.
struct CellCentres {
  CellCentres() = default;
  explicit CellCentres(const Cells& cells);

  std::size_t size = 0;  ///< without the padding
  std::vector<double> x_m, y_m, z_m;
};

}  // namespace comptonaut
