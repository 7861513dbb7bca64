// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "response/response_table.h"

namespace comptonaut {

/// Added to z so that a place at the detector itself has a direction: above it.
inline constexpr double kSomewhere_m = 1e-12;

/// L of singles and of pairs for one direction.
struct Response {
  double single = 0.0;
  double pair = 0.0;
};

/// A response table made continuous, for sources with continuous positions: bilinear between the nodes of an octahedral
/// map, each the mean of the table's entries about it (Gaussian weights, half the entries' spacing wide, which also
/// averages their statistics). Immutable.
class SmoothResponse {
 public:
  explicit SmoothResponse(const ResponseTable& table);

  /// For direction (x, y, z) in D of any length but zero.
  [[nodiscard]] Response operator()(double x, double y, double z) const {
    const Place place = place_of(x, y, z);
    return at(place.a, place.b);
  }

  static constexpr int kEdge = 64;  ///< cells along each edge of the unfolded octahedron

  /// Where a direction lies on the map, 0 to kEdge.
  struct Place {
    double a = 0.0, b = 0.0;
  };
  [[gnu::always_inline]] static inline Place place_of(double x, double y, double z) {
    const double scale = 1.0 / (std::abs(x) + std::abs(y) + std::abs(z));
    const double a = x * scale, b = y * scale;
    const double folded_a = std::copysign(1.0 - std::abs(b), a), folded_b = std::copysign(1.0 - std::abs(a), b);
    return {((z < 0.0 ? folded_a : a) + 1.0) * (0.5 * kEdge), ((z < 0.0 ? folded_b : b) + 1.0) * (0.5 * kEdge)};
  }

  /// At n places at once.
  void at(const double* a, const double* b, std::size_t n, double* single, double* pair) const;

  [[nodiscard]] Response at(double a, double b) const {
    const int i = std::min(static_cast<int>(a), kEdge - 1), j = std::min(static_cast<int>(b), kEdge - 1);
    const double u = a - i, v = b - j;
    const Node* low = &nodes_[static_cast<std::size_t>(j * (kEdge + 1) + i)];
    const Node* high = low + kEdge + 1;
    const double w00 = (1.0 - u) * (1.0 - v), w10 = u * (1.0 - v), w01 = (1.0 - u) * v, w11 = u * v;
    return {.single = w00 * low[0].single + w10 * low[1].single + w01 * high[0].single + w11 * high[1].single,
            .pair = w00 * low[0].pair + w10 * low[1].pair + w01 * high[0].pair + w11 * high[1].pair};
  }

 private:
  struct Node {
    float single = 0.0F;
    float pair = 0.0F;
  };
  std::vector<Node> nodes_;  ///< row by row, kEdge + 1 each
};

}  // namespace comptonaut
