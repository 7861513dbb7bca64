// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "radiation/cell_centres.h"

namespace comptonaut {

/// Values from 0 to 1, each in 16 bits: within 2^-12 = 0.025 % of the true one (a response table is not known that
/// well); below 2^-29 it is zero. Projections take as long as a matrix takes to cross the memory bus, so small is fast.
inline constexpr std::size_t kWordsPerBlock = kBlock / 2;

/// Vectors that meet packed rows are lifted: multiplied by this, a power of two.
inline constexpr double kLift = 0x1p96;

/// A row where it is not zero: blocks of cells in growing order. (Not runs of them: a loop of many short loops costs
/// more in mispredicted branches than in arithmetic.)
struct PackedRow {
  std::vector<std::uint32_t> blocks;
  std::vector<std::uint32_t> words;  ///< kWordsPerBlock for each
};

/// Of values from 0 to 1 of whole blocks.
[[nodiscard]] PackedRow pack(std::span<const float> dense);

/// sum_k t_k x_k for x times kLift and |x| up to 2^30. In single precision and fixed lanes: the same bits on every
/// processor.
[[nodiscard]] double packed_dot(const PackedRow& row, const float* lifted);

/// u_k += t_k y for y times kLift. Meanwhile `next`, the row that is read after it, is fetched to the cache.
void packed_spread(const PackedRow& row, float lifted, float* u, const PackedRow& next);

}  // namespace comptonaut
