// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "core/pose.h"
#include "core/random.h"

namespace comptonaut {

/// Errors of an odometry: each axis of position and attitude wanders about zero (Ornstein and Uhlenbeck 1930), forgets
/// its value within the correlation time, and is off by sigma on the long run, from the start on.
class PoseNoise {
 public:
  PoseNoise(double position_sigma_m, double attitude_sigma_rad, double correlation_s, Random random);

  void step(double dt_s);
  /// `pose` as the odometry tells it; velocities stay right.
  [[nodiscard]] StampedPose disturbed(StampedPose pose) const;

 private:
  [[nodiscard]] Eigen::Vector3d normals();

  double position_sigma_m_;
  double attitude_sigma_rad_;
  double correlation_s_;
  Random random_;
  Eigen::Vector3d position_;  ///< in sigmas
  Eigen::Vector3d attitude_;
};

/// A small rotation by independent normal angles about the three axes.
[[nodiscard]] Eigen::Quaterniond rotation_by(const Eigen::Vector3d& rotation_rad);

}  // namespace comptonaut
