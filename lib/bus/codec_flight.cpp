// SPDX-License-Identifier: BSD-3-Clause
// Poses, the vehicle's state, plans.
#include <comptonaut/msg/plan_t.hpp>
#include <comptonaut/msg/pose_quality_t.hpp>
#include <comptonaut/msg/pose_t.hpp>
#include <comptonaut/msg/vehicle_t.hpp>

#include "bus/codec.h"
#include "bus/codec_keys.h"
#include "bus/valid.h"
#include "bus/wire.h"

namespace comptonaut {
namespace {

constexpr std::string_view kPoseLayout = "8 888 888 8888 888 888";
constexpr std::string_view kPoseQualityLayout = "8 444 1 4";
constexpr std::string_view kVehicleLayout = "84 ?? s 4 888 n*8*8 44 84s";
constexpr std::string_view kPlanLayout = "88488 {n*{488n*8}} s n*{88848}";
constexpr double kMaxSpeed_m_s = 1000.0;

bool unknown_or_sigma(double sigma) { return unknown_or_within(sigma, 0.0, kMaxCoordinate); }

msg::waypoint_t waypoint_to_msg(const Waypoint& waypoint) {
  msg::waypoint_t m;
  pack_vector(waypoint.p_W, m.p_W_m);
  m.speed_max_m_s = static_cast<float>(waypoint.speed_max_m_s);
  m.utime = waypoint.utime;
  return m;
}

std::optional<Waypoint> waypoint_from_msg(const msg::waypoint_t& m) {
  const Waypoint waypoint{.p_W = unpack_vector(m.p_W_m), .speed_max_m_s = m.speed_max_m_s, .utime = m.utime};
  const bool valid =
      valid_vector(waypoint.p_W) && within(waypoint.speed_max_m_s, 0.0, kMaxSpeed_m_s) && valid_utime(waypoint.utime);
  return valid ? std::optional(waypoint) : std::nullopt;
}

bool valid(const VehicleState& v) {
  for (const Eigen::Vector2d& corner : v.fence_m) {
    if (!valid_vector({corner.x(), corner.y(), 0.0})) return false;
  }
  return valid_utime(v.utime) && valid_mav(v.sender) && valid_text(v.mode) &&
         unknown_or_within(v.battery_percent, 0.0, 100.0) && unknown_or_vector(v.p_WHome) &&
         unknown_or_within(v.fence_floor_m, -kMaxCoordinate, kMaxCoordinate) &&
         unknown_or_within(v.fence_ceiling_m, -kMaxCoordinate, kMaxCoordinate) && v.plan_number >= -1 &&
         v.waypoint >= 0 && valid_text(v.hold_reason);
}

}  // namespace

Bytes encode(const StampedPose& pose) {
  msg::pose_t m;
  m.utime = pose.utime;
  pack_vector(pose.p_WB, m.pos);
  pack_vector(pose.v_WB_B, m.vel);
  pack_quaternion(pose.q_WB, m.orientation);
  pack_vector(pose.w_WB_B, m.rotation_rate);
  pack_vector(pose.a_WB_B, m.accel);
  return pack(m);
}

template <>
std::optional<StampedPose> decode(std::span<const std::uint8_t> bytes) {
  const auto m = unpack<msg::pose_t>(bytes, kPoseLayout);
  if (!m) return {};
  const StampedPose pose{.utime = m->utime,
                         .p_WB = unpack_vector(m->pos),
                         .q_WB = unpack_quaternion(m->orientation),
                         .v_WB_B = unpack_vector(m->vel),
                         .w_WB_B = unpack_vector(m->rotation_rate),
                         .a_WB_B = unpack_vector(m->accel)};
  const bool ok = valid_utime(pose.utime) && valid_vector(pose.p_WB) && valid_unit(pose.q_WB) &&
                  valid_vector(pose.v_WB_B) && valid_vector(pose.w_WB_B) && valid_vector(pose.a_WB_B);
  return ok ? std::optional(pose) : std::nullopt;
}

Bytes encode(const PoseQuality& quality) {
  return pack(msg::pose_quality_t{.utime = quality.utime,
                                  .position_sigma_m = static_cast<float>(quality.position_sigma_m),
                                  .height_sigma_m = static_cast<float>(quality.height_sigma_m),
                                  .yaw_sigma_rad = static_cast<float>(quality.yaw_sigma_rad),
                                  .quality_percent = static_cast<std::int8_t>(quality.quality_percent),
                                  .resets = quality.resets});
}

template <>
std::optional<PoseQuality> decode(std::span<const std::uint8_t> bytes) {
  const auto m = unpack<msg::pose_quality_t>(bytes, kPoseQualityLayout);
  if (!m) return {};
  const PoseQuality quality{.utime = m->utime,
                            .position_sigma_m = m->position_sigma_m,
                            .height_sigma_m = m->height_sigma_m,
                            .yaw_sigma_rad = m->yaw_sigma_rad,
                            .quality_percent = m->quality_percent,
                            .resets = m->resets};
  const bool ok = valid_utime(quality.utime) && unknown_or_sigma(quality.position_sigma_m) &&
                  unknown_or_sigma(quality.height_sigma_m) && unknown_or_sigma(quality.yaw_sigma_rad) &&
                  within(quality.quality_percent, -1, 100) && quality.resets >= 0;
  return ok ? std::optional(quality) : std::nullopt;
}

Bytes encode(const VehicleState& vehicle) {
  msg::vehicle_t m;
  m.utime = vehicle.utime;
  m.sender = vehicle.sender;
  m.connected = vehicle.connected;
  m.armed = vehicle.armed;
  m.mode = clean_text(vehicle.mode);
  m.battery_percent = static_cast<float>(vehicle.battery_percent);
  pack_vector(vehicle.p_WHome, m.p_WHome_m);
  m.n_fence = static_cast<std::int32_t>(vehicle.fence_m.size());
  for (const Eigen::Vector2d& corner : vehicle.fence_m) {
    m.fence_x_m.push_back(corner.x());
    m.fence_y_m.push_back(corner.y());
  }
  m.fence_floor_m = static_cast<float>(vehicle.fence_floor_m);
  m.fence_ceiling_m = static_cast<float>(vehicle.fence_ceiling_m);
  m.plan_number = vehicle.plan_number;
  m.waypoint = vehicle.waypoint;
  m.hold_reason = clean_text(vehicle.hold_reason);
  return pack(m);
}

template <>
std::optional<VehicleState> decode(std::span<const std::uint8_t> bytes) {
  const auto m = unpack<msg::vehicle_t>(bytes, kVehicleLayout);
  if (!m) return {};
  VehicleState vehicle{.utime = m->utime,
                       .sender = m->sender,
                       .connected = m->connected != 0,
                       .armed = m->armed != 0,
                       .mode = m->mode,
                       .battery_percent = m->battery_percent,
                       .p_WHome = unpack_vector(m->p_WHome_m),
                       .fence_m = {},
                       .fence_floor_m = m->fence_floor_m,
                       .fence_ceiling_m = m->fence_ceiling_m,
                       .plan_number = m->plan_number,
                       .waypoint = m->waypoint,
                       .hold_reason = m->hold_reason};
  for (std::size_t i = 0; i < m->fence_x_m.size(); ++i) vehicle.fence_m.emplace_back(m->fence_x_m[i], m->fence_y_m[i]);
  return valid(vehicle) ? std::optional(vehicle) : std::nullopt;
}

Bytes encode(const Plan& plan) {
  msg::plan_t m;
  m.mission = plan.mission;
  m.utime = plan.utime;
  m.mav = plan.mav;
  m.term = plan.term;
  m.number = plan.number;
  m.basis = to_msg(plan.basis);
  m.status = clean_text(plan.status);
  pack_all(plan.waypoints, m.n, m.waypoints, waypoint_to_msg);
  return pack(m);
}

template <>
std::optional<Plan> decode(std::span<const std::uint8_t> bytes) {
  const auto m = unpack<msg::plan_t>(bytes, kPlanLayout);
  if (!m) return {};
  auto basis = from_msg(m->basis);
  Plan plan{.mission = m->mission,
            .utime = m->utime,
            .mav = m->mav,
            .term = m->term,
            .number = m->number,
            .basis = basis.value_or(Basis{}),
            .status = m->status,
            .waypoints = {}};
  const bool ok = basis && plan.mission >= 0 && valid_utime(plan.utime) && valid_mav(plan.mav) && plan.term >= 0 &&
                  plan.number >= 0 && valid_text(plan.status) &&
                  unpack_all(m->waypoints, plan.waypoints, waypoint_from_msg);
  return ok ? std::optional(plan) : std::nullopt;
}

}  // namespace comptonaut
