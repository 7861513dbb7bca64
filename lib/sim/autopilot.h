// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/random.h"
#include "core/time.h"
#include "mavlink/mavlink.h"
#include "sim/pose_noise.h"
#include "sim/vehicle.h"

namespace comptonaut {

/// A simulated vehicle behind the MAVLink 2 that a real autopilot speaks: sends ODOMETRY 50 times, HEARTBEAT and
/// SYS_STATUS once a second, takes SET_POSITION_TARGET_LOCAL_NED. Its local NED frame has the origin of W.
class SimAutopilot {
 public:
  using Frame = std::vector<std::uint8_t>;

  /// Its battery is full at start_utime and empty endurance_s later.
  SimAutopilot(int mav, const SimVehicle& vehicle, const PoseNoise& noise, Utime start_utime, double endurance_s);

  void on_mavlink(std::span<const std::uint8_t> bytes);
  /// What it sends at its present time.
  [[nodiscard]] std::vector<Frame> frames();
  /// Flies on for duration_us.
  void fly(Utime duration_us);

  [[nodiscard]] const SimVehicle& vehicle() const { return vehicle_; }

 private:
  [[nodiscard]] Frame frame(const MavlinkMessage& message);
  void take(const SetPositionTarget& target);

  int mav_;
  SimVehicle vehicle_;
  PoseNoise noise_;
  MavlinkParser parser_;
  Utime start_utime_;
  double endurance_s_;
  Utime elapsed_us_ = 0;
  std::uint8_t sequence_ = 0;
};

/// A HEARTBEAT of this MAV's autopilot, from before its first flight.
[[nodiscard]] SimAutopilot::Frame hello_frame(int mav);

}  // namespace comptonaut
