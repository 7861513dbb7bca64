// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/pose_bridge.h"

#include <fmt/format.h>

#include <limits>
#include <variant>

#include "nodes/frames.h"

namespace comptonaut {
namespace {

constexpr Utime kSetpointPeriod_us = 50'000;

std::array<float, 3> floats_N(const Eigen::Vector3d& v_W) {
  const Eigen::Vector3d v_N = swap_W_N(v_W);
  return {static_cast<float>(v_N.x()), static_cast<float>(v_N.y()), static_cast<float>(v_N.z())};
}

// PX4 packs its main mode into the third byte, and the kind of its mode "auto" (4) into the fourth.
std::string px4_mode(std::uint32_t custom_mode) {
  const unsigned main = custom_mode >> 16 & 0xFF, sub = custom_mode >> 24;
  if (main == 6) return "offboard";
  if (main == 4 && sub == 2) return "takeoff";
  if (main == 4 && sub == 3) return "hold";
  if (main == 4 && sub == 4) return "mission";
  if (main == 4 && sub == 5) return "return";
  if (main == 4 && sub == 6) return "land";
  if (main == 1) return "manual";
  if (main == 2) return "altitude";
  if (main == 3) return "position";
  return fmt::format("PX4 mode {}.{}", main, sub);
}

std::string mode_of(const Heartbeat& heartbeat) {
  if ((heartbeat.base_mode & kBaseModeCustom) == 0) return fmt::format("base mode {}", heartbeat.base_mode);
  if (heartbeat.autopilot == kAutopilotPx4) return px4_mode(heartbeat.custom_mode);
  return fmt::format("custom mode {}", heartbeat.custom_mode);
}

/// NaN: not known.
double percent_of(const SysStatus& status) {
  const int percent = status.battery_remaining_percent;
  return percent >= 0 && percent <= 100 ? percent : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

PoseBridge::PoseBridge(const PoseBridgeConfig& config)
    : config_(config),
      intake_(config.p_WN_m),
      pilot_(config.pilot),
      others_(config.pilot.mav, config.pilot.separation.pose_age_max_s) {}

PoseBridge::Output PoseBridge::on_mavlink(std::span<const std::uint8_t> datagram, double monotonic_s) {
  Output output;
  for (const ReceivedMavlink& received : parser_.on_bytes(datagram)) {
    if (received.from.system != config_.pilot.mav) {
      ++from_other_systems_;
    } else if (const auto* heartbeat = std::get_if<Heartbeat>(&received.message)) {
      heartbeat_ = *heartbeat;
      heartbeat_s_ = monotonic_s;
    } else if (const auto* sys_status = std::get_if<SysStatus>(&received.message)) {
      sys_status_ = *sys_status;
    } else if (const auto* odometry = std::get_if<Odometry>(&received.message)) {
      take(*odometry, monotonic_s, output);
    }
  }
  return output;
}

void PoseBridge::take(const Odometry& odometry, double monotonic_s, Output& output) {
  const auto pose = intake_.pose_of(odometry);
  if (!pose) return;
  output.pose = pose;
  output.quality = intake_.quality_of(odometry);
  utime_ = pose->utime;
  const Motion motion = pilot_.steer(*pose, others_.others(), monotonic_s);
  const Utime slot = floor_to(utime_, kSetpointPeriod_us);
  if (slot == setpoint_utime_) return;
  setpoint_utime_ = slot;
  ++setpoints_;
  send(setpoint(motion), output);
}

SetPositionTarget PoseBridge::setpoint(const Motion& motion) const {
  return {.time_boot_ms = static_cast<std::uint32_t>(utime_ / 1000),
          .target_system = static_cast<std::uint8_t>(config_.pilot.mav),
          .target_component = kComponentAutopilot,
          .type_mask = kIgnoreYawRate,
          .position_m = floats_N(motion.p_W - config_.p_WN_m),
          .velocity_m_s = floats_N(motion.v_W),
          .acceleration_m_s2 = floats_N(motion.a_W),
          .yaw_rad = static_cast<float>(heading_from_yaw(config_.yaw_rad))};
}

void PoseBridge::send(const MavlinkMessage& message, Output& output) {
  const MavlinkAddress self{static_cast<std::uint8_t>(config_.pilot.mav), kComponentOnboardComputer};
  output.to_autopilot.push_back(mavlink_frame(message, self, sequence_++));
}

void PoseBridge::on_plan(const Plan& plan, double monotonic_s) { pilot_.take_plan(plan, monotonic_s); }

void PoseBridge::on_other_pose(int mav, const StampedPose& pose) { others_.on_pose(mav, pose, utime_); }

PoseBridge::Output PoseBridge::on_timer(double monotonic_s) {
  Output output;
  send(Heartbeat{.type = kTypeOnboardController, .autopilot = kAutopilotInvalid, .system_status = kStateActive},
       output);
  output.vehicle = VehicleState{.utime = utime_, .sender = config_.pilot.mav, .connected = connected(monotonic_s)};
  if (heartbeat_) {
    output.vehicle->armed = (heartbeat_->base_mode & kBaseModeArmed) != 0;
    output.vehicle->mode = mode_of(*heartbeat_);
  }
  if (sys_status_ && output.vehicle->connected) output.vehicle->battery_percent = percent_of(*sys_status_);
  output.vehicle->p_WHome = pilot_.p_WHome();
  output.vehicle->plan_number = pilot_.plan_number();
  output.vehicle->waypoint = pilot_.waypoint();
  output.vehicle->hold_reason = pilot_.hold_reason();
  return output;
}

bool PoseBridge::connected(double monotonic_s) const {
  return heartbeat_ && monotonic_s - heartbeat_s_ <= config_.heartbeat_timeout_s;
}

std::string PoseBridge::state(double monotonic_s) const {
  if (!connected(monotonic_s)) return "no heartbeat from the autopilot";
  if (!intake_.complaint().empty()) return intake_.complaint();
  return utime_ == 0 ? "no odometry yet" : pilot_.hold_reason();
}

std::vector<Counter> PoseBridge::counters() const {
  const MavlinkCounters& link = parser_.counters();
  std::vector<Counter> result{{"mavlink_messages", link.messages},
                              {"mavlink_lost", link.lost},
                              {"mavlink_bad_checksum", link.bad_checksum},
                              {"mavlink_unknown", link.unknown},
                              {"mavlink_incompatible", link.incompatible},
                              {"mavlink_skipped_bytes", link.skipped_bytes},
                              {"mavlink_other_systems", from_other_systems_},
                              {"setpoints", setpoints_}};
  for (const auto& more : {intake_.counters(), others_.counters(), pilot_.counters()})
    result.insert(result.end(), more.begin(), more.end());
  return result;
}

}  // namespace comptonaut
