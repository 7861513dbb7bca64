// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/pose_bridge.h"

namespace comptonaut {
namespace {

void read_limits(Config& config, MotionLimits& limits) {
  config.read("speed_max_m_s", limits.speed_max_m_s, {.min = 0.1, .max = 30.0});
  config.read("acceleration_max_m_s2", limits.acceleration_max_m_s2, {.min = 0.1, .max = 20.0});
  config.read("corner_deviation_max_m", limits.corner_deviation_max_m, {.min = 0.01, .max = 10.0});
}

void read_separation(Config& config, SeparationConfig& separation) {
  config.read("distance_min_m", separation.distance_min_m, {.min = 0.1, .max = 100.0});
  config.read("give_way_extra_m", separation.give_way_extra_m, {.min = 0.0, .max = 100.0});
  config.read("release_extra_m", separation.release_extra_m, {.min = 0.0, .max = 100.0});
  config.read("reaction_s", separation.reaction_s, {.min = 0.05, .max = 5.0});
  config.read("speed_margin_s", separation.speed_margin_s, {.min = 0.0, .max = 5.0});
  config.read("pose_age_max_s", separation.pose_age_max_s, {.min = 0.1, .max = 60.0});
  config.read("height_weight", separation.height_weight, {.min = 0.1, .max = 1.0});
  config.read("step_aside_after_s", separation.step_aside_after_s, {.min = 0.0, .max = 3600.0});
}

}  // namespace

PoseBridgeConfig read_pose_bridge_config(Config& config) {
  PoseBridgeConfig bridge;
  PilotConfig& pilot = bridge.pilot;
  config.read("p_WN_m", bridge.p_WN_m, {.min = -1e5, .max = 1e5});
  config.read("yaw_rad", bridge.yaw_rad, {.min = -6.3, .max = 6.3});
  config.read("heartbeat_timeout_s", bridge.heartbeat_timeout_s, {.min = 0.5, .max = 60.0});
  config.read("p_WHome_m", pilot.p_WHome_m, {.min = -1e5, .max = 1e5});
  config.read("plan_timeout_s", pilot.plan_timeout_s, {.min = 0.5, .max = 600.0});
  config.read("return_timeout_s", pilot.return_timeout_s, {.min = 1.0, .max = 3600.0});
  if (pilot.return_timeout_s <= pilot.plan_timeout_s) {
    throw config.error("return_timeout_s", "must be longer than plan_timeout_s");
  }
  config.read("return_speed_m_s", pilot.return_speed_m_s, {.min = 0.1, .max = 30.0});
  config.read("return_z_m", pilot.return_z_m, {.min = -1e4, .max = 1e4});
  config.read("tracking_error_max_m", pilot.tracking_error_max_m, {.min = 0.1, .max = 100.0});
  config.section("limits", [&](Config& section) { read_limits(section, pilot.limits); });
  config.section("separation", [&](Config& section) { read_separation(section, pilot.separation); });
  return bridge;
}

}  // namespace comptonaut
