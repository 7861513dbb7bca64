// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "config/config.h"
#include "core/pose.h"
#include "flight/plan.h"
#include "mavlink/mavlink.h"
#include "nodes/odometry_intake.h"
#include "nodes/other_poses.h"
#include "nodes/pilot.h"
#include "nodes/status.h"
#include "nodes/vehicle_state.h"

namespace comptonaut {

struct PoseBridgeConfig {
  Eigen::Vector3d p_WN_m = Eigen::Vector3d::Zero();  ///< origin of the autopilot's local NED frame
  double yaw_rad = 0.0;                              ///< kept while flying; 0 is east
  double heartbeat_timeout_s = 3.0;
  PilotConfig pilot;  ///< pilot.mav is also the system id of the autopilot
};

[[nodiscard]] PoseBridgeConfig read_pose_bridge_config(Config& config);

/// Between the autopilot (MAVLink, NED and FRD) and the rest (ENU and FLU): poses in, setpoints along the plan out.
/// No LCM, no sockets, no clock of its own: replaying the same inputs gives the same outputs. `monotonic_s` drives
/// liveness only; trajectories run on the time of the odometry.
///
/// How plans are flown, and when not, is the Pilot's business.
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
  void take(const Odometry& odometry, double monotonic_s, Output& output);
  [[nodiscard]] SetPositionTarget setpoint(const Motion& motion) const;
  [[nodiscard]] bool connected(double monotonic_s) const;
  void send(const MavlinkMessage& message, Output& output);

  PoseBridgeConfig config_;
  MavlinkParser parser_;
  OdometryIntake intake_;
  Pilot pilot_;
  OtherPoses others_;
  std::optional<Heartbeat> heartbeat_;
  std::optional<SysStatus> sys_status_;
  double heartbeat_s_ = 0.0;  ///< monotonic time of the last one
  Utime utime_ = 0;           ///< of the last pose
  Utime setpoint_utime_ = 0;  ///< begin of the 50 ms that had the last setpoint
  std::uint8_t sequence_ = 0;
  std::int64_t setpoints_ = 0, from_other_systems_ = 0;
};

}  // namespace comptonaut
