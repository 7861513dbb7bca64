// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/aligned.h"
#include "radiation/packed_rows.h"

namespace comptonaut {

/// Sums of rows over cells: in single precision for a few rows, then in double, so that many small terms count.
class BackSum {
 public:
  explicit BackSum(std::size_t cells) : few_(cells, 0.0F), all_(cells, 0.0) {}
  /// Where to add the next n rows, n at most kTileRows and a divisor of it where they are not the last.
  [[nodiscard]] float* next_rows(std::size_t n);
  [[nodiscard]] std::vector<double> total() const;

 private:
  AlignedVector<float> few_;
  std::vector<double> all_;
  std::size_t rows_ = 0;
};

/// The rows t_i of the system matrix, stored where they are not zero, each value in 16 bits (packed_rows.h says how
/// exact that is), in tiles: some rows over a panel of cells, small enough for the second cache.
class SystemRows {
 public:
  static constexpr std::size_t kTileRows = 32;
  using Tile = std::vector<PackedRows>;  ///< per panel

  explicit SystemRows(std::size_t cells);

  [[nodiscard]] std::size_t cells() const { return cells_; }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] const std::vector<Tile>& tiles() const { return tiles_; }

  /// Adds a row of values >= 0 divided by the largest of them, and left out where that is below row_cut. (A row's scale
  /// does not matter to MLEM.) A row of zeros is left out: false.
  bool add(const SparseRow& row, double row_cut = 0.0);

  /// sum_i t_ij / sum_k t_ik, padded: ratio_back of a uniform lambda of 1, the same bits, kept up to date as rows come.
  [[nodiscard]] std::vector<double> uniform_ratio() const;

 private:
  [[nodiscard]] Tile new_tile() const;

  std::size_t cells_, size_ = 0;
  std::vector<Tile> tiles_;
  AlignedVector<float> ones_;
  BackSum uniform_ratio_;
};

/// sum_j t_ij x_j for each row. `x` is padded. Summed in single precision in fixed lanes, within 1e-5 of the exact sum
/// of rows of 10^4 cells and the same bits on every processor; here and below.
[[nodiscard]] std::vector<double> forward(const SystemRows& rows, std::span<const double> x);

/// sum_i t_ij y_i for each cell, padded.
[[nodiscard]] std::vector<double> back(const SystemRows& rows, std::span<const double> y);

/// sum_i t_ij / sum_k t_ik lambda_k for each cell, padded; rows that lambda does not reach (not by 1e-30 of its
/// largest) count nothing. One pass over the matrix.
[[nodiscard]] std::vector<double> ratio_back(const SystemRows& rows, std::span<const double> lambda);

}  // namespace comptonaut
