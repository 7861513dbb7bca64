// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <bit>
#include <cstdint>

#include "core/simd.h"
#include "search/prospect.h"

namespace comptonaut {
namespace {

constexpr std::size_t kLanes = 16;
using Floats = float __attribute__((vector_size(4 * kLanes), aligned(4), may_alias));
using Words = std::int32_t __attribute__((vector_size(4 * kLanes), aligned(4), may_alias));

/// exp(-x) for x >= 0, within 1e-6 of its value; 1e-35 or so beyond x = 80. As exp_minus_inline: 2^-n exp(r), exp(r) by
/// its series up to r^6.
[[gnu::always_inline]] inline void exp_minus(Floats x, Floats& result) {
  constexpr float kLog2E = 1.44269504F, kLn2High = 0.693359375F, kLn2Low = -2.12194440e-4F;
  constexpr float kRounder = 0x1.8p23F;  // adding it leaves the nearest whole number in the low bits
  const Floats most = Floats{} + 80.0F;
  x = x < most ? x : most;
  const Floats shifted = x * kLog2E + kRounder;
  const Floats n = shifted - kRounder;
  const Floats r = (n * kLn2High - x) + n * kLn2Low;
  Floats series = r * (1.0F / 720.0F) + 1.0F / 120.0F;
  series = series * r + 1.0F / 24.0F;
  series = series * r + 1.0F / 6.0F;
  series = series * r + 0.5F;
  series = series * r + 1.0F;
  series = series * r + 1.0F;
  const Words whole = reinterpret_cast<const Words&>(shifted) - std::bit_cast<std::int32_t>(kRounder);
  const Words power = (127 - whole) << 23;
  result = series * reinterpret_cast<const Floats&>(power);
}

[[gnu::always_inline]] inline void add_worth(const float* weight, const float* known, Floats& sum) {
  Floats unanswered;
  exp_minus(*reinterpret_cast<const Floats*>(known), unanswered);
  sum += *reinterpret_cast<const Floats*>(weight) * (1.0F - unanswered);
}

COMPTONAUT_SIMD_CLONES
void add_worths(const float* weight, const float* known, std::size_t n, float* sums) {
  Floats sum{};
  std::size_t k = 0;
  for (; k + kLanes <= n; k += kLanes) add_worth(weight + k, known + k, sum);
  float last_weight[kLanes] = {}, last_known[kLanes] = {};
  for (std::size_t i = 0; k < n; ++i, ++k) last_weight[i] = weight[k], last_known[i] = known[k];
  add_worth(last_weight, last_known, sum);
  *reinterpret_cast<Floats*>(sums) = sum;
}

COMPTONAUT_SIMD_CLONES
void add_seconds(const float* per_s, float time_s, std::size_t n, float* known) {
  for (std::size_t k = 0; k < n; ++k) known[k] += time_s * per_s[k];
}

}  // namespace

double worth(const Prospect& prospect, const Eigen::ArrayXf& known) {
  std::array<float, kLanes> sums;
  add_worths(prospect.weight.data(), known.data(), static_cast<std::size_t>(known.size()), sums.data());
  double sum = 0.0;
  for (const float lane : sums) sum += static_cast<double>(lane);
  return sum;
}

void look(const Prospect& prospect, std::size_t square, double time_s, Eigen::ArrayXf& known) {
  add_seconds(prospect.per_s.col(static_cast<Eigen::Index>(square)).data(), static_cast<float>(time_s),
              static_cast<std::size_t>(known.size()), known.data());
}

}  // namespace comptonaut
