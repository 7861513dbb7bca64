// SPDX-License-Identifier: BSD-3-Clause
#include "core/pose.h"

#include <cmath>

namespace comptonaut {

std::optional<StampedPose> interpolate(const StampedPose& before, const StampedPose& after, Utime utime) {
  if (utime < before.utime || utime > after.utime) return std::nullopt;
  if (before.utime == after.utime) return before;
  const double f = static_cast<double>(utime - before.utime) / static_cast<double>(after.utime - before.utime);
  const auto mix = [f](const Eigen::Vector3d& a, const Eigen::Vector3d& b) -> Eigen::Vector3d {
    return a + f * (b - a);
  };
  return StampedPose{.utime = utime,
                     .p_WB = mix(before.p_WB, after.p_WB),
                     .q_WB = before.q_WB.slerp(f, after.q_WB),
                     .v_WB_B = mix(before.v_WB_B, after.v_WB_B),
                     .w_WB_B = mix(before.w_WB_B, after.w_WB_B),
                     .a_WB_B = mix(before.a_WB_B, after.a_WB_B)};
}

Eigen::Quaterniond from_yaw(double yaw_rad) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()));
}

double yaw_of(const Eigen::Quaterniond& q_WB) {
  const Eigen::Vector3d forward_W = q_WB * Eigen::Vector3d::UnitX();
  return std::atan2(forward_W.y(), forward_W.x());
}

}  // namespace comptonaut
