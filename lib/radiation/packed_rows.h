// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/aligned.h"
#include "radiation/cell_centres.h"

namespace comptonaut {

/// A row of the system matrix as it is filled: blocks of cells in growing order, kBlock values for each.
struct SparseRow {
  std::vector<std::uint32_t> blocks;
  AlignedVector<float> values;  ///< may be longer
};

/// Cells are projected in panels of so many blocks: what a panel's cells hold stays in the first cache (16 kB).
inline constexpr std::size_t kPanelBlocks = 256;
inline constexpr std::size_t kPanelCells = kPanelBlocks * kBlock;

/// Some rows where they are not zero, over the cells of a panel. Values from 0 to 1, each in 16 bits: within 2^-12 =
/// 0.025 % of the true one (a response table is not known that well); below 2^-29 it is zero. Projections take as long
/// as a matrix takes to cross the memory bus, so small is fast.
struct PackedRows {
  std::vector<std::uint16_t> blocks;  ///< within the panel
  BlankVector<std::uint16_t> values;  ///< kBlock for each
  std::vector<std::uint32_t> ends;    ///< of each row's blocks
};

/// Vectors that meet packed rows are lifted: multiplied by this, a power of two.
inline constexpr double kLift = 0x1p96;

/// The largest of n values, none negative; n a multiple of kBlock.
[[nodiscard]] float largest_of(const float* values, std::size_t n);

/// Appends a row: of the n blocks from `first_block` of the panel's those that are not all zeros, their values times
/// `scale` or zero where they are below `cut` before that.
void append_packed(const std::uint32_t* blocks, const float* values, std::size_t n, std::uint32_t first_block,
                   float cut, float scale, PackedRows& rows);

/// sums[i] += sum_k t_ik x_k for rows from `first` on and x times kLift, |x| up to 2^30. In single precision and fixed
/// lanes: the same bits on every processor. Meanwhile `next`, which is read after them, is fetched to the cache: here
/// one half of it, by packed_spread the other.
void packed_dots(const PackedRows& rows, std::size_t first, const float* lifted, double* sums, const PackedRows& next);

/// u_k += sum_i t_ik y_i for rows from `first` on and y times kLift, in order; `next` as above.
void packed_spread(const PackedRows& rows, std::size_t first, const float* lifted, float* u, const PackedRows& next);

}  // namespace comptonaut
