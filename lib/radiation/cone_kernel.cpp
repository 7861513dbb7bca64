// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/cone_kernel.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "radiation/simd.h"
#include "radiation/view.h"

namespace comptonaut {
namespace {

/// exp(-x) for 0 <= x <= 80, within 4e-7 of its value, as exp_minus_inline.
[[gnu::always_inline]] inline float quick_exp_minus(float x) {
  constexpr float kRounder = 0x1.8p23F;
  const float shifted = x * 1.44269504F + kRounder;
  const float n = shifted - kRounder;
  const float r = (n * 0.693359375F - x) + n * -2.12194440e-4F;  // ln 2 in two parts
  float series = 1.0F / 720.0F;
  series = series * r + 1.0F / 120.0F;
  series = series * r + 1.0F / 24.0F;
  series = series * r + 1.0F / 6.0F;
  series = series * r + 0.5F;
  series = series * r + 1.0F;
  series = series * r + 1.0F;
  const std::int32_t whole = std::bit_cast<std::int32_t>(shifted) - std::bit_cast<std::int32_t>(kRounder);
  return series * std::bit_cast<float>((127 - whole) << 23);
}

/// arcsin(s) for 0 <= s <= sqrt(1/2), within 2e-7: interpolated at Chebyshev's points of s^2.
[[gnu::always_inline]] inline float quick_asin(float square) {
  const float s = std::sqrt(square);
  float series = 0.0842982019F;
  series = series * square + -0.0476147478F;
  series = series * square + 0.0478787905F;
  series = series * square + 0.0255488432F;
  series = series * square + 0.0450644932F;
  series = series * square + 0.0749865166F;
  series = series * square + 0.166666736F;
  return s + s * square * series;
}

}  // namespace

COMPTONAUT_SIMD_CLONES
void cone_kernel(const double* __restrict x_m, const double* __restrict y_m, const double* __restrict z_m,
                 std::size_t n, const ConeKernel& cone, float* __restrict t) {
  constexpr auto kSquareMin = static_cast<float>(kDistanceMin_m * kDistanceMin_m);
  constexpr auto kPi = std::numbers::pi_v<float>;
  const ConeKernel c = cone;
  for (std::size_t i = 0; i < n; ++i) {
    const auto dx = static_cast<float>(x_m[i] - c.px_m);
    const auto dy = static_cast<float>(y_m[i] - c.py_m);
    const auto dz = static_cast<float>(z_m[i] - c.pz_m);
    const float square = dx * dx + dy * dy + dz * dz + 1e-20F;
    const float d = std::sqrt(square), per_d = 1.0F / d;
    // Half the chord to the axis or against it, whichever is shorter, is the sine of half the angle: exact near both.
    const float ux = dx * per_d, uy = dy * per_d, uz = dz * per_d;
    const bool front = ux * c.ax + uy * c.ay + uz * c.az >= 0.0F;
    const float sign = front ? -1.0F : 1.0F;
    const float vx = ux + sign * c.ax, vy = uy + sign * c.ay, vz = uz + sign * c.az;
    const float half = 2.0F * quick_asin(0.25F * (vx * vx + vy * vy + vz * vz));
    const float pull = ((front ? half : kPi - half) - c.beta_rad) * c.per_sigma;
    const float half_square = 0.5F * pull * pull;
    const float clipped = square > kSquareMin ? square : kSquareMin;
    const float exponent = half_square + c.attenuation_per_m * d;
    const float value = quick_exp_minus(exponent < 80.0F ? exponent : 80.0F) / clipped;
    t[i] = half_square <= c.half_square_max ? value : 0.0F;
  }
}

COMPTONAUT_SIMD_CLONES
float largest_of(const float* t, std::size_t n) {
  using Lanes = std::int32_t __attribute__((vector_size(4 * kBlock), aligned(4), may_alias));
  Lanes largest{};  // floats that are not negative are ordered as their bits are
  for (std::size_t i = 0; i < n; i += kBlock) {
    const Lanes bits = *reinterpret_cast<const Lanes*>(t + i);
    largest = bits > largest ? bits : largest;
  }
  std::int32_t result = 0;
  for (std::size_t i = 0; i < kBlock; ++i) result = largest[i] > result ? largest[i] : result;
  return std::bit_cast<float>(result);
}

COMPTONAUT_SIMD_CLONES
void cut_and_scale(float* __restrict t, std::size_t n, float cut, float scale) {
  for (std::size_t i = 0; i < n; ++i) t[i] = t[i] < cut ? 0.0F : t[i] * scale;
}

}  // namespace comptonaut
