// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "core/time.h"

namespace comptonaut {

/// Pose and motion of a MAV's body B (forward-left-up) in the world W (east-north-up) at one moment.
struct StampedPose {
  Utime utime = 0;
  Eigen::Vector3d p_WB = Eigen::Vector3d::Zero();            ///< m
  Eigen::Quaterniond q_WB = Eigen::Quaterniond::Identity();  ///< rotates B to W
  Eigen::Vector3d v_WB_B = Eigen::Vector3d::Zero();          ///< velocity in W, expressed in B, m/s
  Eigen::Vector3d w_WB_B = Eigen::Vector3d::Zero();          ///< angular velocity in W, expressed in B, rad/s
  Eigen::Vector3d a_WB_B = Eigen::Vector3d::Zero();          ///< acceleration in W, expressed in B, m/s^2

  [[nodiscard]] Eigen::Isometry3d X_WB() const { return Eigen::Translation3d(p_WB) * q_WB; }
};

/// The pose at `utime` between two poses: positions and rates linear, rotation by slerp.
/// nullopt unless before.utime <= utime <= after.utime.
[[nodiscard]] std::optional<StampedPose> interpolate(const StampedPose& before, const StampedPose& after, Utime utime);

/// Rotation about z of W by `yaw_rad`, from x (east) towards y (north).
[[nodiscard]] Eigen::Quaterniond from_yaw(double yaw_rad);

/// Yaw of a rotation, rad in (-pi, pi].
[[nodiscard]] double yaw_of(const Eigen::Quaterniond& q_WB);

}  // namespace comptonaut
