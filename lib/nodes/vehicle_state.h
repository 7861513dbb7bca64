// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "core/time.h"

namespace comptonaut {

/// How far the pose of the same utime may be trusted. NaN: unknown.
struct PoseQuality {
  Utime utime = 0;
  double position_sigma_m = std::numeric_limits<double>::quiet_NaN();  ///< horizontal
  double height_sigma_m = std::numeric_limits<double>::quiet_NaN();
  double yaw_sigma_rad = std::numeric_limits<double>::quiet_NaN();
  std::int32_t quality_percent = -1;  ///< of the odometry; -1: unknown
  std::int32_t resets = 0;            ///< jumps of the estimator since its start
};

/// The vehicle as the autopilot tells it, and what the pose bridge makes it do.
struct VehicleState {
  Utime utime = 0;
  std::int32_t sender = 0;  ///< MAV number
  bool connected = false;   ///< heartbeat heard within its timeout
  bool armed = false;
  std::string mode;
  double battery_percent = std::numeric_limits<double>::quiet_NaN();
  Eigen::Vector3d p_WHome = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  std::vector<Eigen::Vector2d> fence_m;  ///< polygon in the horizontal plane of W
  double fence_floor_m = std::numeric_limits<double>::quiet_NaN();
  double fence_ceiling_m = std::numeric_limits<double>::quiet_NaN();
  std::int64_t plan_number = -1;  ///< plan that is flown; -1: none
  std::int32_t waypoint = 0;      ///< index of the waypoint that is flown to
  std::string hold_reason;        ///< empty while flying a plan
};

}  // namespace comptonaut
