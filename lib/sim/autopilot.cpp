// SPDX-License-Identifier: BSD-3-Clause
#include "sim/autopilot.h"

#include <algorithm>
#include <numbers>
#include <variant>

namespace comptonaut {
namespace {

constexpr Utime kOdometryPeriod_us = 20'000;

/// ENU to NED and back: x and y change places, z its sign.
Eigen::Vector3d swapped(const Eigen::Vector3d& p) { return {p.y(), p.x(), -p.z()}; }
/// FLU to FRD and back.
Eigen::Vector3d flipped(const Eigen::Vector3d& v) { return {v.x(), -v.y(), -v.z()}; }

/// Half a turn about (1, 1, 0) takes ENU to NED; half a turn about x takes FLU to FRD.
Eigen::Quaterniond ned_frd(const Eigen::Quaterniond& q_WB) {
  const double half = std::numbers::sqrt2 / 2.0;
  return Eigen::Quaterniond(0, half, half, 0) * q_WB * Eigen::Quaterniond(0, 1, 0, 0);
}

std::array<float, 3> floats(const Eigen::Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

Eigen::Vector3d vector(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }

Odometry odometry(const StampedPose& pose) {
  const Eigen::Quaterniond q = ned_frd(pose.q_WB);
  Odometry message;
  message.time_usec = static_cast<std::uint64_t>(pose.utime);
  message.position_m = floats(swapped(pose.p_WB));
  message.q = {static_cast<float>(q.w()), static_cast<float>(q.x()), static_cast<float>(q.y()),
               static_cast<float>(q.z())};
  message.velocity_m_s = floats(flipped(pose.v_WB_B));
  message.rates_rad_s = floats(flipped(pose.w_WB_B));
  message.quality = 100;
  return message;
}

Heartbeat heartbeat() {
  return {.type = kTypeQuadrotor,
          .autopilot = kAutopilotPx4,
          .base_mode = kBaseModeCustom | kBaseModeArmed,
          .system_status = kStateActive};
}

SysStatus sys_status(double battery_left) {
  return {.battery_remaining_percent = static_cast<std::int8_t>(100.0 * std::max(0.0, battery_left))};
}

}  // namespace

SimAutopilot::SimAutopilot(int mav, const SimVehicle& vehicle, const PoseNoise& noise, Utime start_utime,
                           double endurance_s)
    : mav_(mav), vehicle_(vehicle), noise_(noise), start_utime_(start_utime), endurance_s_(endurance_s) {}

SimAutopilot::Frame SimAutopilot::frame(const MavlinkMessage& message) {
  return mavlink_frame(message, {static_cast<std::uint8_t>(mav_), kComponentAutopilot}, sequence_++);
}

std::vector<SimAutopilot::Frame> SimAutopilot::frames() {
  std::vector<Frame> result;
  if (elapsed_us_ % kSecond_us == 0) {
    result.push_back(frame(heartbeat()));
    result.push_back(frame(sys_status(1.0 - seconds(elapsed_us_) / endurance_s_)));
  }
  if (elapsed_us_ % kOdometryPeriod_us == 0) {
    StampedPose pose = noise_.disturbed(vehicle_.pose());
    pose.utime = start_utime_ + elapsed_us_;
    result.push_back(frame(odometry(pose)));
  }
  return result;
}

SimAutopilot::Frame hello_frame(int mav) {
  return mavlink_frame(heartbeat(), {static_cast<std::uint8_t>(mav), kComponentAutopilot}, 0);
}

void SimAutopilot::fly(Utime duration_us) {
  vehicle_.step(seconds(elapsed_us_), seconds(duration_us));
  noise_.step(seconds(duration_us));
  elapsed_us_ += duration_us;
}

void SimAutopilot::take(const SetPositionTarget& target) {
  if (target.coordinate_frame != kFrameLocalNed || (target.type_mask & kIgnorePosition) != 0) return;
  Setpoint setpoint{.p_W = swapped(vector(target.position_m))};
  if ((target.type_mask & kIgnoreVelocity) == 0) setpoint.v_W = swapped(vector(target.velocity_m_s));
  if ((target.type_mask & kIgnoreAcceleration) == 0) setpoint.a_W = swapped(vector(target.acceleration_m_s2));
  if ((target.type_mask & kIgnoreYaw) == 0) setpoint.yaw_rad = 0.5 * std::numbers::pi - target.yaw_rad;
  const bool finite = setpoint.p_W.allFinite() && setpoint.v_W.allFinite() && setpoint.a_W.allFinite() &&
                      std::isfinite(setpoint.yaw_rad.value_or(0.0));
  if (finite) vehicle_.command(setpoint, seconds(elapsed_us_));
}

void SimAutopilot::on_mavlink(std::span<const std::uint8_t> bytes) {
  for (const ReceivedMavlink& received : parser_.on_bytes(bytes)) {
    const auto* target = std::get_if<SetPositionTarget>(&received.message);
    if (target && target->target_system == mav_) take(*target);
  }
}

}  // namespace comptonaut
