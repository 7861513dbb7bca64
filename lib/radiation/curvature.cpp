// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/curvature.h"

#include <algorithm>
#include <limits>

#include "core/simd.h"
#include "radiation/cell_centres.h"

namespace comptonaut {
namespace {

constexpr int kSweepsMax = 1000;
using BlockFloats = float __attribute__((vector_size(4 * kBlock), aligned(4), may_alias));

/// H[i][j] += sum_r a[r][i] a[r][j] for two rows of H, j below `columns`, a multiple of kBlock.
[[gnu::always_inline]] inline void add_to_rows(const float* a, std::size_t stride, std::size_t i, std::size_t columns,
                                               float* H) {
  float first[Curvature::kRows], second[Curvature::kRows];
  for (std::size_t r = 0; r < Curvature::kRows; ++r) {
    first[r] = a[r * stride + i];
    second[r] = a[r * stride + i + 1];
  }
  for (std::size_t j = 0; j < columns; j += kBlock) {
    auto* to = reinterpret_cast<BlockFloats*>(H + i * stride + j);
    auto* below = reinterpret_cast<BlockFloats*>(H + (i + 1) * stride + j);
    BlockFloats sum = *to, sum_below = *below;
    for (std::size_t r = 0; r < Curvature::kRows; ++r) {
      const BlockFloats from = *reinterpret_cast<const BlockFloats*>(a + r * stride + j);
      sum += first[r] * from;
      sum_below += second[r] * from;
    }
    *to = sum;
    *below = sum_below;
  }
}

/// The lower half of H, and what shares its blocks.
COMPTONAUT_SIMD_CLONES
void add_products(const float* a, std::size_t stride, float* H) {
  for (std::size_t i = 0; i < stride; i += 2) add_to_rows(a, stride, i, padded(i + 2), H);
}

COMPTONAUT_SIMD_CLONES
void subtract(const float* row, float factor, float* rest, std::size_t n) {
  for (std::size_t j = 0; j < n; ++j) rest[j] -= factor * row[j];
}

}  // namespace

Curvature::Curvature(std::size_t variables)
    : variables_(variables), stride_(padded(variables)), few_(kRows * stride_, 0.0F), all_(stride_ * stride_, 0.0F) {}

float* Curvature::next_row() {
  if (rows_ == kRows) take_in();
  return &few_[stride_ * rows_++];
}

void Curvature::take_in() {
  add_products(few_.data(), stride_, all_.data());
  std::fill(few_.begin(), few_.end(), 0.0F);
  rows_ = 0;
}

AlignedVector<float> Curvature::finish() {
  take_in();
  for (std::size_t i = 0; i < variables_; ++i) {
    for (std::size_t j = i + 1; j < variables_; ++j) all_[i * stride_ + j] = all_[j * stride_ + i];
  }
  all_.resize(variables_ * stride_);
  return std::move(all_);
}

QuadraticStep quadratic_step(std::span<const float> curvature, std::span<const double> gradient,
                             std::span<const double> x, double gain_min) {
  const std::size_t n = x.size(), stride = padded(n);
  QuadraticStep result{.step = std::vector<double>(n, 0.0)};
  AlignedVector<float> rest(stride, 0.0F);
  for (std::size_t i = 0; i < n; ++i) rest[i] = static_cast<float>(gradient[i]);
  double gained = std::numeric_limits<double>::infinity();
  for (int sweep = 0; sweep < kSweepsMax && gained > 1e-3 * gain_min; ++sweep) {
    gained = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      const auto h = static_cast<double>(curvature[i * stride + i]), slope = static_cast<double>(rest[i]);
      if (!(h > 0.0)) continue;
      const double to = std::max(result.step[i] + slope / h, -x[i]), by = to - result.step[i];
      if (by == 0.0) continue;
      gained += by * (slope - 0.5 * h * by);
      result.step[i] = to;
      subtract(&curvature[i * stride], static_cast<float>(by), rest.data(), stride);
    }
    result.gain += gained;
  }
  return result;
}

}  // namespace comptonaut
