// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/map_projection.h"

#include "core/simd.h"

namespace comptonaut {
namespace {

constexpr std::size_t kLanes = 8;
using Floats = float __attribute__((vector_size(4 * kLanes), aligned(4), may_alias));
using Doubles = double __attribute__((vector_size(8 * kLanes), aligned(8), may_alias));

}  // namespace

COMPTONAUT_SIMD_CLONES
double row_dot(const float* row, const double* x, std::size_t n) {
  Doubles even{}, odd{};
  for (std::size_t k = 0; k < n; k += 2 * kLanes) {
    even += __builtin_convertvector(*reinterpret_cast<const Floats*>(row + k), Doubles) *
            *reinterpret_cast<const Doubles*>(x + k);
    odd += __builtin_convertvector(*reinterpret_cast<const Floats*>(row + k + kLanes), Doubles) *
           *reinterpret_cast<const Doubles*>(x + k + kLanes);
  }
  const Doubles sum = even + odd;
  return ((sum[0] + sum[4]) + (sum[1] + sum[5])) + ((sum[2] + sum[6]) + (sum[3] + sum[7]));
}

COMPTONAUT_SIMD_CLONES
void row_spread(const float* row, double factor, double* u, std::size_t n) {
  for (std::size_t k = 0; k < n; k += kLanes) {
    *reinterpret_cast<Doubles*>(u + k) +=
        factor * __builtin_convertvector(*reinterpret_cast<const Floats*>(row + k), Doubles);
  }
}

}  // namespace comptonaut
