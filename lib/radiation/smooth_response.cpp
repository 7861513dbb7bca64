// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/smooth_response.h"

#include <array>
#include <cstdint>
#include <numbers>

#include "core/simd.h"

namespace comptonaut {
namespace {

Eigen::Vector3d unfolded(double a, double b) {
  const double z = 1.0 - std::abs(a) - std::abs(b);
  if (z >= 0.0) return Eigen::Vector3d(a, b, z).normalized();
  return Eigen::Vector3d(std::copysign(1.0 - std::abs(b), a), std::copysign(1.0 - std::abs(a), b), z).normalized();
}

constexpr std::size_t kFew = 128;  // places that are looked up at a time

/// A place's lower node, and what its four nodes count.
struct Lookup {
  std::array<std::int32_t, kFew> node;
  std::array<double, kFew> w00, w10, w01, w11;
};

COMPTONAUT_SIMD_CLONES
void look_up(const double* __restrict a, const double* __restrict b, std::size_t n, Lookup* __restrict to) {
  constexpr std::int32_t kLast = SmoothResponse::kEdge - 1;
  for (std::size_t k = 0; k < n; ++k) {
    const auto whole_a = static_cast<std::int32_t>(a[k]), whole_b = static_cast<std::int32_t>(b[k]);
    const std::int32_t i = whole_a < kLast ? whole_a : kLast, j = whole_b < kLast ? whole_b : kLast;
    const double u = a[k] - i, v = b[k] - j;
    to->node[k] = j * (SmoothResponse::kEdge + 1) + i;
    to->w00[k] = (1.0 - u) * (1.0 - v);
    to->w10[k] = u * (1.0 - v);
    to->w01[k] = (1.0 - u) * v;
    to->w11[k] = u * v;
  }
}

using Two = double __attribute__((vector_size(16)));
using TwoFloats = float __attribute__((vector_size(8), aligned(4), may_alias));

[[gnu::always_inline]] inline Two both(const float* node) {
  return __builtin_convertvector(*reinterpret_cast<const TwoFloats*>(node), Two);
}

}  // namespace

void SmoothResponse::at(const double* a, const double* b, std::size_t n, double* single, double* pair) const {
  Lookup places;
  for (std::size_t first = 0; first < n; first += kFew) {
    const std::size_t few = std::min(kFew, n - first);
    look_up(a + first, b + first, few, &places);
    for (std::size_t k = 0; k < few; ++k) {
      const Node* low = &nodes_[static_cast<std::size_t>(places.node[k])];
      const Node* high = low + kEdge + 1;
      const Two L = places.w00[k] * both(&low[0].single) + places.w10[k] * both(&low[1].single) +
                    places.w01[k] * both(&high[0].single) + places.w11[k] * both(&high[1].single);
      single[first + k] = L[0];
      pair[first + k] = L[1];
    }
  }
}

SmoothResponse::SmoothResponse(const ResponseTable& table) {
  const auto& entries = table.entries();
  std::vector<Eigen::Vector3d> directions_D;
  for (const ResponseEntry& entry : entries) directions_D.push_back(direction_D(entry.phi_rad, entry.theta_rad));
  const double width_rad = 0.5 * std::sqrt(4.0 * std::numbers::pi / static_cast<double>(entries.size()));
  for (int j = 0; j <= kEdge; ++j) {
    for (int i = 0; i <= kEdge; ++i) {
      const Eigen::Vector3d node_D = unfolded(2.0 * i / kEdge - 1.0, 2.0 * j / kEdge - 1.0);
      const double nearest_m2 = 2.0 - 2.0 * node_D.dot(directions_D[table.nearest(node_D)]);
      double weights = 0.0, single = 0.0, pair = 0.0;
      for (std::size_t k = 0; k < entries.size(); ++k) {
        const double chord_m2 = 2.0 - 2.0 * node_D.dot(directions_D[k]);
        const double weight = std::exp(-0.5 * (chord_m2 - nearest_m2) / (width_rad * width_rad));
        weights += weight;
        single += weight * entries[k].single;
        pair += weight * entries[k].pair;
      }
      nodes_.push_back({.single = static_cast<float>(single / weights), .pair = static_cast<float>(pair / weights)});
    }
  }
}

}  // namespace comptonaut
