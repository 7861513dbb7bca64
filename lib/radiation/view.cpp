// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/view.h"

#include <algorithm>
#include <cmath>

#include "core/simd.h"
#include "radiation/exp_minus.h"

namespace comptonaut {
namespace {

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
    const double square = dx * dx + dy * dy + dz * dz;
    view->z_D[i] = square > 0.0 ? R.zx * dx + R.zy * dy + R.zz * dz : kDistanceMin_m;
    const double clipped = square > kSquareMin ? square : kSquareMin;
    const double d = std::sqrt(clipped);
    view->d_m[i] = d;
    view->weight_per_m2[i] = exp_minus_inline(mu * d) / clipped;
  }
}

Rotation rotation_of(const Eigen::Matrix3d& R) {
  return {R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2)};
}

}  // namespace

double exp_minus(double x) { return exp_minus_inline(x); }

void see(const CellCentres& cells, std::size_t first, std::size_t n, const Eye& eye, View& view) {
  see_chunk(&cells.x_m[first], &cells.y_m[first], &cells.z_m[first], n, eye.p_W.x(), eye.p_W.y(), eye.p_W.z(),
            rotation_of(eye.R_DW), eye.attenuation_per_m, &view);
}

COMPTONAUT_SIMD_CLONES
void accumulate(const float* __restrict response, const double* __restrict weight, double factor, double* __restrict s,
                std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) s[i] += factor * static_cast<double>(response[i]) * weight[i];
}

COMPTONAUT_SIMD_CLONES
void accumulate(const double* __restrict response, const double* __restrict weight, double factor, double* __restrict s,
                std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) s[i] += factor * response[i] * weight[i];
}

COMPTONAUT_SIMD_CLONES
void multiply(double* __restrict t, const double* __restrict factor, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) t[i] *= factor[i];
}

}  // namespace comptonaut
