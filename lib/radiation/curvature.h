// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/aligned.h"

namespace comptonaut {

/// H = sum_r a_r a_r^T of rows that come one after another, in single precision: the curvature of a likelihood.
class Curvature {
 public:
  explicit Curvature(std::size_t variables);
  /// The next row, of padded(variables) elements, to be set before the next call; all zeros until then.
  [[nodiscard]] float* next_row();
  /// After the last row: n rows of padded(n) elements, symmetric.
  [[nodiscard]] AlignedVector<float> finish();

  static constexpr std::size_t kRows = 16;  ///< taken in at a time

 private:
  void take_in();

  std::size_t variables_, stride_, rows_ = 0;
  AlignedVector<float> few_, all_;
};

/// A step, and what it gains where the curvature is all there is to know.
struct QuadraticStep {
  std::vector<double> step;
  double gain = 0.0;
};

/// The step d with x + d >= 0 that gains most of gradient . d - d^T H d / 2, within a thousandth of gain_min of it or
/// so: along one coordinate after another, over and over. `curvature` as Curvature gives it; variables that it says
/// nothing of stay where they are.
[[nodiscard]] QuadraticStep quadratic_step(std::span<const float> curvature, std::span<const double> gradient,
                                           std::span<const double> x, double gain_min);

}  // namespace comptonaut
