// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>

namespace comptonaut {

/// Stands in for a response table: smooth, different in every direction, of a real table's size.
inline double toy_pair_response(const Eigen::Vector3d& direction_D) {
  const Eigen::Vector3d u_D = direction_D.normalized();
  return 3e-8 * (1.0 + 0.3 * u_D.z() * u_D.z() + 0.1 * u_D.x() - 0.05 * u_D.y());
}

inline void toy_pair_lookup(const float* x, const float* y, const float* z, float* value, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) value[i] = static_cast<float>(toy_pair_response({x[i], y[i], z[i]}));
}

}  // namespace comptonaut
