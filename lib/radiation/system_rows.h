// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "radiation/cell_centres.h"

namespace comptonaut {

/// The rows t_i of the system matrix, stored where they are not zero: runs of whole blocks of cells, each value in 16
/// bits, since MLEM takes as long as the matrix takes to cross the memory bus. A stored value is within 2^-12 = 0.025 %
/// of the true one (a response table is not known that well); below 2^-29 it is zero.
class SystemRows {
 public:
  /// Blocks [first_block, first_block + blocks) of one row; their values follow those of the run before.
  struct Run {
    std::uint32_t first_block = 0;
    std::uint32_t blocks = 0;
  };
  struct Row {
    std::vector<Run> runs;
    std::vector<std::uint64_t> words;  ///< four values each, see system_rows.cpp
  };

  explicit SystemRows(std::size_t cells);

  [[nodiscard]] std::size_t cells() const { return cells_; }
  [[nodiscard]] const std::vector<Row>& rows() const { return rows_; }

  /// Adds a row given by all its cells, values from 0 to 1, padding included, which must be zero there. (A row's scale
  /// does not matter to MLEM.) A row of zeros is left out: false.
  bool add(std::span<const float> dense);

  /// sum_i t_ij / sum_k t_ik, padded: ratio_back of a uniform lambda of 1, the same bits, kept up to date as rows come.
  [[nodiscard]] std::vector<double> uniform_ratio() const;

 private:
  std::size_t cells_;
  std::vector<Row> rows_;
  std::vector<double> ones_;
  std::vector<double> uniform_ratio_;
};

/// sum_j t_ij x_j for each row. `x` is padded. Summed in lanes of double precision, so that the order, and so the
/// result, is the same on every processor; here and below.
[[nodiscard]] std::vector<double> forward(const SystemRows& rows, std::span<const double> x);

/// sum_i t_ij y_i for each cell, padded.
[[nodiscard]] std::vector<double> back(const SystemRows& rows, std::span<const double> y);

/// sum_i t_ij / sum_k t_ik lambda_k for each cell, padded; rows that lambda does not reach count nothing. One pass over
/// the matrix.
[[nodiscard]] std::vector<double> ratio_back(const SystemRows& rows, std::span<const double> lambda);

}  // namespace comptonaut
