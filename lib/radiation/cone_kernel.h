// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace comptonaut {

/// One cone of the world as a row's arithmetic needs it.
struct ConeKernel {
  double px_m, py_m, pz_m;  ///< scatter point
  float ax, ay, az;         ///< axis, unit vector
  float beta_rad;
  float per_sigma;          ///< 1 / sigma
  float half_square_max;    ///< where (delta / sigma)^2 / 2 is larger, h is zero
  float attenuation_per_m;  ///< mu
};

/// exp(-mu d) / d^2 h(delta) of n cells, a multiple of kBlock, in single precision: within 3e-5 of its value, or 1e-6
/// of h's largest. d is at least kDistanceMin_m. The same bits on every processor.
void cone_kernel(const double* x_m, const double* y_m, const double* z_m, std::size_t n, const ConeKernel& cone,
                 float* t);

/// The largest of n values, none negative; n a multiple of kBlock.
[[nodiscard]] float largest_of(const float* t, std::size_t n);

/// t *= scale; zero where t is below `cut`.
void cut_and_scale(float* t, std::size_t n, float cut, float scale);

}  // namespace comptonaut
