// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "radiation/packed_row.h"

namespace comptonaut {

/// Sums of rows over cells: in single precision for a few rows, then in double, so that many small terms count.
class BackSum {
 public:
  explicit BackSum(std::size_t cells) : few_(cells, 0.0F), all_(cells, 0.0) {}
  [[nodiscard]] float* next_row();
  [[nodiscard]] std::vector<double> total() const;

 private:
  std::vector<float> few_;
  std::vector<double> all_;
  int rows_ = 0;
};

/// The rows t_i of the system matrix, stored where they are not zero, each value in 16 bits (packed_row.h says how
/// exact that is).
class SystemRows {
 public:
  explicit SystemRows(std::size_t cells);

  [[nodiscard]] std::size_t cells() const { return cells_; }
  [[nodiscard]] const std::vector<PackedRow>& rows() const { return rows_; }

  /// Adds a row given by all its cells, values from 0 to 1, padding included, which must be zero there. (A row's scale
  /// does not matter to MLEM.) A row of zeros is left out: false.
  bool add(std::span<const float> dense);

  /// sum_i t_ij / sum_k t_ik, padded: ratio_back of a uniform lambda of 1, the same bits, kept up to date as rows come.
  [[nodiscard]] std::vector<double> uniform_ratio() const;

 private:
  std::size_t cells_;
  std::vector<PackedRow> rows_;
  std::vector<float> ones_;
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
