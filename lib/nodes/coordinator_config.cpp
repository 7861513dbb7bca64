// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/coordinator_config.h"

#include <fmt/format.h>

#include <algorithm>

#include "config/area.h"
#include "nodes/mav_channel.h"

namespace comptonaut {
namespace {

constexpr double kWaypointsMax = 16;  // what a plan's datagram has room for

void read_mavs(Config& config, std::vector<int>& mavs) {
  config.read("mavs", mavs, {.min = 1, .max = kMaxMav});
  std::vector<int> sorted = mavs;
  std::sort(sorted.begin(), sorted.end());
  const bool twice = std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
  if (mavs.empty() || std::ssize(mavs) > kMaxTeam || twice) {
    throw config.error("mavs", fmt::format("must be a list of 1 to {} numbers, none of them twice", kMaxTeam));
  }
}

void read_fence(Config& config, Fence& fence) {
  config.each("corners", [&](Config& corner) {
    Eigen::Vector2d& p_W = fence.border.emplace_back(Eigen::Vector2d::Zero());
    corner.require("x_m", p_W.x(), Range{-1e5, 1e5});
    corner.require("y_m", p_W.y(), Range{-1e5, 1e5});
  });
  if (fence.border.size() == 1 || fence.border.size() == 2) {
    throw config.error("corners", fmt::format("{} are not enough, must be 3 at least", fence.border.size()));
  }
  if (!fence.border.empty() && !is_simple(fence.border)) {
    throw config.error("corners", "the fence's edges cross or touch, must be in order round it");
  }
  config.read("floor_m", fence.floor_m, {.min = -1e4, .max = 1e4});
  config.read("ceiling_m", fence.ceiling_m, {.min = fence.floor_m, .max = 1e4});
}

}  // namespace

CoordinatorConfig read_coordinator_config(Config& config) {
  CoordinatorConfig coordinator;
  config.require("mission", coordinator.mission, Range{.min = 0});
  read_mavs(config, coordinator.mavs);
  config.read("nuclide", coordinator.nuclide);
  config.require("response_table", coordinator.response_table);
  config.read("cone_density", coordinator.cone_density);
  config.read("more_nuclides", coordinator.more_nuclides);
  coordinator.terrain = read_terrain_config(config);
  config.read("obstacle_attenuation_per_m", coordinator.obstacle_attenuation_per_m, {.min = 0.0, .max = 1e4});
  config.section("area", [&](Config& section) { coordinator.area = read_area(section); });
  config.read("cell_m", coordinator.cell_m, {.min = 0.05, .max = 100.0});
  config.read("speed_max_m_s", coordinator.speed_max_m_s, {.min = 0.1, .max = 50.0});
  config.read("acceleration_max_m_s2", coordinator.acceleration_max_m_s2, {.min = 0.1, .max = 50.0});
  config.read("corner_deviation_max_m", coordinator.corner_deviation_max_m, {.min = 0.01, .max = 10.0});
  config.read("fence_margin_m", coordinator.fence_margin_m, {.min = 0.0, .max = 1e4});
  config.read("endurance_s", coordinator.endurance_s, {.min = 0.0, .max = 1e6});
  config.read("reserve_s", coordinator.reserve_s, {.min = 0.0, .max = 1e5});
  config.read("battery_reserve_percent", coordinator.battery_reserve_percent, {.min = 0.0, .max = 90.0});
  config.read("gap_give_up_s", coordinator.gap_give_up_s, {.min = 0.1, .max = 3600.0});
  config.read("map_period_s", coordinator.map_period_s, {.min = 1.0, .max = 3600.0});
  config.read("lease_s", coordinator.lease_s, {.min = 0.5, .max = 600.0});
  config.read("plan_waypoints_max", coordinator.plan_waypoints_max, {.min = 1, .max = kWaypointsMax});
  config.read("estimator", coordinator.estimator, kEstimators);
  config.section("joint", [&](Config& section) { coordinator.joint = read_joint_config(section); });
  config.section("mlem", [&](Config& section) { coordinator.mlem = read_mlem_config(section); });
  config.section("search", [&](Config& section) { coordinator.search = read_search_config(section); });
  config.section("fence", [&](Config& section) { read_fence(section, coordinator.search.route.fence); });
  return coordinator;
}

Fence fence_of(const CoordinatorConfig& config) {
  Fence fence = config.search.route.fence;
  if (fence.border.empty()) fence.border = polygon_of(config.area, config.fence_margin_m);
  return fence;
}

std::optional<ConeDensity> load_cone_density(const CoordinatorConfig& config) {
  if (config.cone_density.empty()) return std::nullopt;
  return ConeDensity::load(config.cone_density);
}

}  // namespace comptonaut
