// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "response/cone_density.h"

namespace comptonaut {

/// arccos for |x| <= 1, within 3e-8 [Abramowitz and Stegun 1964, 4.4.46]: cheaper than the exact one, the same bits
/// everywhere.
[[nodiscard, gnu::always_inline]] inline double quick_acos(double x) {
  const double a = std::abs(x);
  double series = -0.0012624911;
  series = series * a + 0.0066700901;
  series = series * a - 0.0170881256;
  series = series * a + 0.0308918810;
  series = series * a - 0.0501743046;
  series = series * a + 0.0889789874;
  series = series * a - 0.2145988016;
  series = series * a + 1.5707963050;
  const double positive = std::sqrt(1.0 - a) * series;
  return x < 0.0 ? std::numbers::pi - positive : positive;
}

/// A ConeDensity tabulated in 1 MB, for the second cache: a row per half degree of beta, in it the density at every
/// half degree of the angle to the axis. Between rows the density moves along with beta: within 3 % of the exact one
/// where sin(beta) >= 0.5, 8 % where it is >= 0.2, 12 % elsewhere. Immutable.
class ConeTable {
 public:
  static constexpr int kRows = 360, kSteps = 360;
  static constexpr double kRowsPerRad = kRows / std::numbers::pi, kStepsPerRad = kSteps / std::numbers::pi;

  /// attitude_sigma_rad: of the cones' axes, per axis, from pose and mount.
  ConeTable(const ConeDensity& density, double attitude_sigma_rad);

  /// Density of the source's direction, per steradian; cos_alpha = u . axis in -1 to 1, beta in 0 to pi.
  [[nodiscard]] double per_sr(Readings readings, double beta_rad, double cos_alpha) const {
    const int row = static_cast<int>(beta_rad * kRowsPerRad + 0.5);
    const double at = (quick_acos(cos_alpha) - beta_rad) * kStepsPerRad + row * (kSteps / kRows);
    const double clipped = std::clamp(at, 0.0, static_cast<double>(kSteps));
    const int step = std::min(static_cast<int>(clipped), kSteps - 1);
    const float* values =
        &values_[static_cast<std::size_t>(((readings == Readings::kSole ? kRows + 1 : 0) + row) * (kSteps + 1))];
    const double low = values[step], high = values[step + 1];
    return low + (clipped - step) * (high - low);
  }

  /// Some cones as arrays.
  struct Cones {
    static constexpr std::size_t kMost = 64;
    std::array<double, kMost> beta_rad;
    std::array<std::int32_t, kMost> row;  ///< of all, of both readings

    void set(std::size_t i, Readings readings, double beta) {
      beta_rad[i] = beta;
      row[i] = static_cast<int>(beta * kRowsPerRad + 0.5) + (readings == Readings::kSole ? kRows + 1 : 0);
    }
  };
  /// density[i] += weight[i] per_sr(cone i, cos_alpha[i]), i < n.
  void add(const Cones& cones, const double* cos_alpha, const double* weight, std::size_t n, double* density) const;
  /// The same of one cone and one weight, any n.
  void add(Readings readings, double beta_rad, const double* cos_alpha, std::size_t n, double weight,
           double* density) const;

 private:
  std::vector<float> values_;  ///< kBoth, then kSole; kRows + 1 rows each of kSteps + 1
};

}  // namespace comptonaut
