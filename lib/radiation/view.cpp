// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/view.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "radiation/simd.h"

namespace comptonaut {
namespace {

/// exp(-x) = 2^-n exp(r) with n = round(x / ln 2), |r| <= ln(2) / 2; exp(r) by its series up to r^8, whose rest is
/// below 3e-10. Without branches and calls, so that the compiler can work on several x at once.
__attribute__((always_inline)) inline double exp_minus_inline(double x) {
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

struct Rotation {
  double xx, xy, xz, yx, yy, yz, zx, zy, zz;
};

COMPTONAUT_SIMD_CLONES
void see_chunk(const double* __restrict x_m, const double* __restrict y_m, const double* __restrict z_m, std::size_t n,
               double px, double py, double pz, Rotation R, double mu, View* __restrict view) {
  constexpr double kSquareMin = kDistanceMin_m * kDistanceMin_m;
  for (std::size_t i = 0; i < n; ++i) {
    const double dx = x_m[i] - px, dy = y_m[i] - py, dz = z_m[i] - pz;
    view->x_D[i] = R.xx * dx + R.xy * dy + R.xz * dz;
    view->y_D[i] = R.yx * dx + R.yy * dy + R.yz * dz;
    view->z_D[i] = R.zx * dx + R.zy * dy + R.zz * dz;
    const double square = dx * dx + dy * dy + dz * dz;
    const double clipped = square > kSquareMin ? square : kSquareMin;
    const double d = std::sqrt(clipped);
    view->d_m[i] = d;
    view->weight_per_m2[i] = exp_minus_inline(mu * d) / clipped;
  }
}

}  // namespace

double exp_minus(double x) { return exp_minus_inline(x); }

void see(const CellCentres& cells, std::size_t first, std::size_t n, const Eye& eye, View& view) {
  const Eigen::Matrix3d& R = eye.R_DW;
  const Rotation rotation{R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2)};
  see_chunk(&cells.x_m[first], &cells.y_m[first], &cells.z_m[first], n, eye.p_W.x(), eye.p_W.y(), eye.p_W.z(), rotation,
            eye.attenuation_per_m, &view);
}

COMPTONAUT_SIMD_CLONES
void accumulate(const double* __restrict response, const double* __restrict weight, double factor, double* __restrict s,
                std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) s[i] += factor * response[i] * weight[i];
}

}  // namespace comptonaut
