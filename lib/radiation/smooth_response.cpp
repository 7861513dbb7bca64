// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/smooth_response.h"

#include <numbers>

namespace comptonaut {
namespace {

Eigen::Vector3d unfolded(double a, double b) {
  const double z = 1.0 - std::abs(a) - std::abs(b);
  if (z >= 0.0) return Eigen::Vector3d(a, b, z).normalized();
  return Eigen::Vector3d(std::copysign(1.0 - std::abs(b), a), std::copysign(1.0 - std::abs(a), b), z).normalized();
}

}  // namespace

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
