// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace comptonaut {

/// The autopilot's frames and ours. N is its local frame (north-east-down), F its body frame (forward-right-down).
/// Each swap of axes is its own inverse. Nothing outside the pose bridge knows of N and F.

/// A vector's coordinates in W (east-north-up) from those in N, and back.
[[nodiscard]] inline Eigen::Vector3d swap_W_N(const Eigen::Vector3d& v) { return {v.y(), v.x(), -v.z()}; }

/// A vector's coordinates in B (forward-left-up) from those in F, and back.
[[nodiscard]] inline Eigen::Vector3d swap_B_F(const Eigen::Vector3d& v) { return {v.x(), -v.y(), -v.z()}; }

/// q_WB from q_NF: R_WB = R_WN R_NF R_FB. R_WN is half a turn about (1, 1, 0), R_FB half a turn about x.
[[nodiscard]] inline Eigen::Quaterniond q_WB_from_NF(const Eigen::Quaterniond& q_NF) {
  const double half = std::numbers::sqrt2 / 2.0;
  return Eigen::Quaterniond(0, half, half, 0) * q_NF * Eigen::Quaterniond(0, 1, 0, 0);
}

/// Heading, clockwise from north, from yaw, anticlockwise from east; in [-pi, pi].
[[nodiscard]] inline double heading_from_yaw(double yaw_rad) {
  return std::remainder(0.5 * std::numbers::pi - yaw_rad, 2.0 * std::numbers::pi);
}

}  // namespace comptonaut
