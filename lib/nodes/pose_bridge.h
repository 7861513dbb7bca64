// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "config/config.h"
#include "core/pose.h"
#include "flight/plan.h"
#include "flight/trajectory.h"
#include "mavlink/mavlink.h"
#include "nodes/status.h"
#include "nodes/vehicle_state.h"

namespace comptonaut {

/// When a MAV stops for another one, whatever its plan says. Distances count height differences at `height_weight`,
/// less than fully, because of the down-wash.
struct SeparationConfig {
  double distance_min_m = 2.0;      ///< no MAV goes on towards another one below this
  double give_way_extra_m = 1.0;    ///< a higher-numbered MAV gives way that much earlier
  double release_extra_m = 0.5;     ///< and goes on only above that much more
  double reaction_s = 0.5;          ///< looked ahead beyond the time to brake
  double step_aside_after_s = 3.0;  ///< of standing, a higher-numbered MAV moves sideways out of the way
  double pose_age_max_s = 2.0;      ///< after which another MAV's pose says nothing
  double height_weight = 0.7;
};

struct PoseBridgeConfig {
  int mav = 1;                                       ///< this MAV: system id of its autopilot
  Eigen::Vector3d p_WN_m = Eigen::Vector3d::Zero();  ///< origin of the autopilot's local NED frame
  /// Where to return to; NaN: where the first odometry says.
  Eigen::Vector3d p_WHome_m = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  MotionLimits limits;
  double yaw_rad = 0.0;            ///< kept while flying; 0 is east
  double plan_timeout_s = 3.0;     ///< without a plan: hold
  double return_timeout_s = 15.0;  ///< without a plan: fly home
  double return_speed_m_s = 2.0;
  double heartbeat_timeout_s = 3.0;
  double tracking_error_max_m =
      1.0;  ///< of the vehicle; beyond it a new plan starts from the vehicle, not its setpoint
  SeparationConfig separation;
};

[[nodiscard]] PoseBridgeConfig read_pose_bridge_config(Config& config);

/// Between the autopilot (MAVLink, NED and FRD) and the rest (ENU and FLU): poses in, setpoints along the plan out.
/// No LCM, no sockets, no clock of its own: replaying the same inputs gives the same outputs. `monotonic_s` drives
/// liveness only; trajectories run on the time of the odometry.
///
/// Only a newer plan for this MAV is flown: greater (term, number). One whose waypoints are the rest of the flown one
/// changes nothing; where it differs later on, the flight bends from the present motion without a stop.
/// Odometry that is not finite, not in the frames above, not in Unix time or older than the last is refused and
/// counted; after twenty refusals in a row because of the time, the autopilot's clock is taken as set anew.
class PoseBridge {
 public:
  explicit PoseBridge(const PoseBridgeConfig& config);

  struct Output {
    std::vector<std::vector<std::uint8_t>> to_autopilot;  ///< MAVLink frames, one datagram each
    std::optional<StampedPose> pose;  ///< the newest one; its acceleration is not told by the autopilot, so 0
    std::optional<PoseQuality> quality;
    std::optional<VehicleState> vehicle;
  };

  /// Bytes from the autopilot. Each odometry gives a pose, and a setpoint at most every 50 ms of its time.
  Output on_mavlink(std::span<const std::uint8_t> datagram, double monotonic_s);
  void on_plan(const Plan& plan, double monotonic_s);
  void on_other_pose(int mav, const StampedPose& pose);
  /// To be called about once a second: heartbeat to the autopilot, vehicle state.
  Output on_timer(double monotonic_s);

  [[nodiscard]] std::vector<Counter> counters() const;
  /// In words, empty while flying a plan: why it holds, or what is wrong with the odometry.
  [[nodiscard]] std::string state(double monotonic_s) const;

 private:
  PoseBridgeConfig config_;
};

}  // namespace comptonaut
