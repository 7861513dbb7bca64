// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>

namespace comptonaut {

/// The point of the straight line from a to b, ends included, that is nearest to p.
template <int kDim>
Eigen::Vector<double, kDim> nearest_on(const Eigen::Vector<double, kDim>& a, const Eigen::Vector<double, kDim>& b,
                                       const Eigen::Vector<double, kDim>& p) {
  const Eigen::Vector<double, kDim> along = b - a;
  const double length2 = along.squaredNorm();
  return length2 > 0.0 ? a + std::clamp((p - a).dot(along) / length2, 0.0, 1.0) * along : a;
}

}  // namespace comptonaut
