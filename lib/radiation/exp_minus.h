// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstdint>

namespace comptonaut {

/// exp(-x) for x >= 0, within 1e-9 of its value; 1e-304 or so beyond x = 700. The same bits on every processor.
///
/// exp(-x) = 2^-n exp(r) with n = round(x / ln 2), |r| <= ln(2) / 2; exp(r) by its series up to r^8, whose rest is
/// below 3e-10. Without branches and calls, so that the compiler can work on several x at once.
[[gnu::always_inline]] inline double exp_minus_inline(double x) {
  constexpr double kLog2E = 1.4426950408889634;
  constexpr double kLn2High = 6.93147180369123816490e-01;  // exact products with n, the rest of ln 2 apart
  constexpr double kLn2Low = 1.90821492927058770002e-10;
  constexpr double kRounder = 0x1.8p52;  // adding it leaves the nearest whole number in the low bits
  x = x < 700.0 ? x : 700.0;
  const double shifted = x * kLog2E + kRounder;
  const double n = shifted - kRounder;
  const double r = (n * kLn2High - x) + n * kLn2Low;
  double series = 1.0 / 40320.0;
  series = series * r + 1.0 / 5040.0;
  series = series * r + 1.0 / 720.0;
  series = series * r + 1.0 / 120.0;
  series = series * r + 1.0 / 24.0;
  series = series * r + 1.0 / 6.0;
  series = series * r + 0.5;
  series = series * r + 1.0;
  series = series * r + 1.0;
  const std::int64_t whole = std::bit_cast<std::int64_t>(shifted) - std::bit_cast<std::int64_t>(kRounder);
  return series * std::bit_cast<double>((1023 - whole) << 52);
}

}  // namespace comptonaut
