// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>

#include "radiation/cell_centres.h"

namespace comptonaut {

/// The response table L of one kind of event: value[i] for the direction (x[i], y[i], z[i]) in D, i < n. Directions
/// are not zero, but need not be of unit length. L is the chance that a decay at 1 m gives such an event.
using ResponseLookup = std::function<void(const float* x, const float* y, const float* z, float* value, std::size_t n)>;

/// Cells are seen in chunks of at most so many, which stay in the first cache.
inline constexpr std::size_t kChunk = 256;

/// Nothing comes closer to a detector than this: d is not taken smaller, which keeps 1 / d^2 finite.
inline constexpr double kDistanceMin_m = 0.1;

/// Cells [first, first + n) seen from a point of W.
struct View {
  std::array<double, kChunk> x_D, y_D, z_D;  ///< from the point to the cell, in D, m
  std::array<double, kChunk> d_m;            ///< distance, at least kDistanceMin_m
  std::array<double, kChunk> weight_per_m2;  ///< exp(-mu d) / d^2
};

/// From where and through what cells are seen.
struct Eye {
  Eigen::Vector3d p_W;
  Eigen::Matrix3d R_DW;            ///< rotates W to D
  double attenuation_per_m = 0.0;  ///< mu >= 0
};

/// Fills `view` for cells [first, first + n), where one at the point itself lies straight above it (+z_D); both are
/// multiples of kBlock, n is at most kChunk. The same bits on every processor: no fused multiply-add, and an
/// exponential of its own.
void see(const CellCentres& cells, std::size_t first, std::size_t n, const Eye& eye, View& view);

/// f(view, first, n) for cells [first, first + n), chunk after chunk.
template <typename F>
void for_each_chunk(const CellCentres& cells, const Eye& eye, const F& f) {
  View view;
  for (std::size_t first = 0; first < cells.size; first += kChunk) {
    const std::size_t n = std::min(kChunk, cells.size - first);
    see(cells, first, padded(n), eye, view);
    f(view, first, n);
  }
}

/// exp(-x) for x >= 0, within 1e-9 of its value; 1e-304 or so beyond x = 700.
[[nodiscard]] double exp_minus(double x);

/// s[j] += factor * L[j] * weight[j], j < n.
void accumulate(const float* response, const double* weight, double factor, double* s, std::size_t n);
void accumulate(const double* response, const double* weight, double factor, double* s, std::size_t n);

/// t *= factor
void multiply(double* t, const double* factor, std::size_t n);

}  // namespace comptonaut
