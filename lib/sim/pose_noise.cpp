// SPDX-License-Identifier: BSD-3-Clause
#include "sim/pose_noise.h"

#include <cmath>

namespace comptonaut {

Eigen::Quaterniond rotation_by(const Eigen::Vector3d& rotation_rad) {
  const double angle_rad = rotation_rad.norm();
  if (angle_rad == 0.0) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle_rad, rotation_rad / angle_rad));
}

PoseNoise::PoseNoise(double position_sigma_m, double attitude_sigma_rad, double correlation_s, Random random)
    : position_sigma_m_(position_sigma_m),
      attitude_sigma_rad_(attitude_sigma_rad),
      correlation_s_(correlation_s),
      random_(random),
      position_(normals()),
      attitude_(normals()) {}

Eigen::Vector3d PoseNoise::normals() {
  Eigen::Vector3d result;
  for (double& x : result) x = random_.normal();
  return result;
}

void PoseNoise::step(double dt_s) {
  const double kept = std::exp(-dt_s / correlation_s_);
  const double added = std::sqrt(1.0 - kept * kept);
  position_ = kept * position_ + added * normals();
  attitude_ = kept * attitude_ + added * normals();
}

StampedPose PoseNoise::disturbed(StampedPose pose) const {
  pose.p_WB += position_sigma_m_ * position_;
  pose.q_WB = pose.q_WB * rotation_by(attitude_sigma_rad_ * attitude_);
  return pose;
}

}  // namespace comptonaut
