// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/map_projection.h"

#include "core/simd.h"
#include "radiation/cell_centres.h"

namespace comptonaut {

COMPTONAUT_SIMD_CLONES
double row_dot(const float* __restrict row, const double* __restrict x, std::size_t n) {
  double sum[kBlock] = {};
  for (std::size_t k = 0; k < n; k += kBlock) {
    for (std::size_t i = 0; i < kBlock; ++i) sum[i] += static_cast<double>(row[k + i]) * x[k + i];
  }
  const auto of_two = [&](std::size_t i) { return sum[i] + sum[i + kBlock / 2]; };
  return ((of_two(0) + of_two(4)) + (of_two(1) + of_two(5))) + ((of_two(2) + of_two(6)) + (of_two(3) + of_two(7)));
}

COMPTONAUT_SIMD_CLONES
void row_spread(const float* __restrict row, double factor, double* __restrict u, std::size_t n, const float* next) {
  for (std::size_t k = 0; k < n; k += kBlock) {
    __builtin_prefetch(next + k);
#pragma GCC unroll 1  // several at once instead
    for (std::size_t i = 0; i < kBlock; ++i) u[k + i] += factor * static_cast<double>(row[k + i]);
  }
}

COMPTONAUT_SIMD_CLONES
void row_pick(const float* __restrict row, const std::uint32_t* __restrict at, const float* __restrict weight,
              float factor, float* __restrict picked, std::size_t n, const float* next) {
  for (std::size_t k = 0; k < n; ++k) __builtin_prefetch(next + at[k]);
  for (std::size_t k = 0; k < n; ++k) picked[k] = row[at[k]] * (factor * weight[k]);
}

}  // namespace comptonaut
