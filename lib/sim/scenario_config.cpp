// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "config/area.h"
#include "nodes/coordinator_config.h"
#include "physics/shield.h"
#include "sim/scenario.h"
#include "sim/scenario_world.h"

namespace comptonaut {
namespace {

constexpr double kFar_m = 1e5;
constexpr double kStrong_Bq = 1e15;
constexpr double kHigh_m = 100.0;
/// A MAV of a corner start stands this far from the area's border, the next ones this far along x from it.
constexpr double kCornerMargin_m = 1.0;
constexpr double kStartSpacing_m = 4.0;

std::vector<Eigen::Vector2d> corner_start(const std::string& corner, int count, const Area& area) {
  const bool south = corner.starts_with("south");
  const bool west = corner.ends_with("west");
  std::vector<Eigen::Vector2d> start;
  for (int i = 0; i < count; ++i) {
    const double inward_m = kCornerMargin_m + kStartSpacing_m * i;
    start.emplace_back(west ? area.x_min_m + inward_m : area.x_max_m - inward_m,
                       south ? area.y_min_m + kCornerMargin_m : area.y_max_m - kCornerMargin_m);
  }
  return start;
}

void read_mavs(Config& config, const Area& area, ScenarioMavs& mavs) {
  config.require("count", mavs.count, Range{1, kMaxTeam});
  config.read("height_m", mavs.height_m, {.min = 0.5, .max = 100.0});
  config.read("speed_max_m_s", mavs.speed_max_m_s, {.min = 0.1, .max = 30.0});
  config.read("acceleration_max_m_s2", mavs.acceleration_max_m_s2, {.min = 0.1, .max = 30.0});
  config.read("endurance_s", mavs.endurance_s, {.min = 1.0, .max = 1e6});
  std::string corner = "south-west";
  config.read("corner", corner, {"south-west", "south-east", "north-west", "north-east"});
  config.each("start", [&](Config& start) {
    Eigen::Vector2d& p_W = mavs.start_W.emplace_back();
    start.require("x_m", p_W.x(), Range{area.x_min_m, area.x_max_m});
    start.require("y_m", p_W.y(), Range{area.y_min_m, area.y_max_m});
  });
  if (mavs.start_W.empty()) mavs.start_W = corner_start(corner, mavs.count, area);
  if (static_cast<int>(mavs.start_W.size()) != mavs.count) {
    throw config.error("start",
                       fmt::format("{} places, must be one for each of {} MAVs", mavs.start_W.size(), mavs.count));
  }
  for (const Eigen::Vector2d& p_W : mavs.start_W) {
    if (!area.contains(p_W.x(), p_W.y())) {
      throw config.error("count", fmt::format("{} MAVs do not fit beside each other into a corner", mavs.count));
    }
  }
}

/// Throws where a MAV would begin in an obstacle or in unknown space.
void check_starts(const Config& config, const Scenario& scenario) {
  const Eigen::Vector3d room_m(0.6, 0.6, 1.0);
  for (std::size_t i = 0; i < scenario.mavs.start_W.size(); ++i) {
    const Eigen::Vector2d& start_W = scenario.mavs.start_W[i];
    const auto ground_m = scenario.world.ground_height_m(start_W.x(), start_W.y());
    const Eigen::Vector3d p_W(start_W.x(), start_W.y(), ground_m.value_or(0.0) + scenario.mavs.height_m);
    if (ground_m && !scenario.world.closed(Box{.min_W = p_W - room_m, .max_W = p_W + room_m})) continue;
    throw config.error("mavs", fmt::format("MAV {} would begin at ({}, {}, {}), in an obstacle or in unknown space",
                                           i + 1, p_W.x(), p_W.y(), p_W.z()));
  }
}

/// Throws unless the scenario knows the nuclide.
void check_nuclide(const Config& config, const char* key, const Scenario& scenario, const std::string& nuclide) {
  const std::vector<std::string>& more = scenario.more_nuclides;
  if (nuclide == scenario.nuclide || std::find(more.begin(), more.end(), nuclide) != more.end()) return;
  throw config.error(key, fmt::format("{} is not allowed, must be nuclide or one of more_nuclides", nuclide));
}

void read_draw(Config& config, const Scenario& scenario, SourceDraw& draw) {
  config.read("activities_Bq", draw.activities_Bq, {.min = 1.0, .max = kStrong_Bq});
  config.read("count", draw.count, {.min = 1, .max = 1000});
  if (draw.activities_Bq.empty() == (draw.count == 0)) {
    throw config.error("activities_Bq", "either a list of activities or a count must be given, not both");
  }
  if (draw.count > 0) {
    config.require("activity_min_Bq", draw.activity_min_Bq, Range{1.0, kStrong_Bq});
    config.require("activity_max_Bq", draw.activity_max_Bq, Range{draw.activity_min_Bq, kStrong_Bq});
  }
  config.read("distance_min_m", draw.distance_min_m, {.min = 0.0, .max = kFar_m});
  config.read("margin_m", draw.margin_m, {.min = 0.0, .max = kFar_m});
  config.read("height_m", draw.height_m, {.min = 0.0, .max = kHigh_m});
  config.read("surface_max_m", draw.surface_max_m, {.min = -kFar_m});
  config.read("behind_walls", draw.behind_walls, {.min = 0, .max = 1000});
  config.read("nuclides", draw.nuclides);
  for (const std::string& nuclide : draw.nuclides) check_nuclide(config, "nuclides", scenario, nuclide);
}

double ground_m(const Config& config, const Scenario& scenario, double x_m, double y_m) {
  if (const auto z_m = scenario.world.ground_height_m(x_m, y_m)) return *z_m;
  throw config.error("x_m", fmt::format("the world has no ground at ({}, {})", x_m, y_m));
}

TrueSource read_source(Config& config, const Scenario& scenario) {
  const Area& area = scenario.area;
  TrueSource source{.nuclide = scenario.nuclide};
  config.read("nuclide", source.nuclide);
  check_nuclide(config, "nuclide", scenario, source.nuclide);
  config.require("x_m", source.p_W.x(), Range{area.x_min_m, area.x_max_m});
  config.require("y_m", source.p_W.y(), Range{area.y_min_m, area.y_max_m});
  double above_m = 0.0;
  config.read("z_m", above_m, {.min = 0.0, .max = kHigh_m});
  source.p_W.z() = ground_m(config, scenario, source.p_W.x(), source.p_W.y()) + above_m;
  config.require("activity_Bq", source.activity_Bq, Range{1.0, kStrong_Bq});
  return source;
}

Patch read_patch(Config& config, const Scenario& scenario) {
  const Area& area = scenario.area;
  Patch patch;
  config.require("x_m", patch.x_m, Range{area.x_min_m, area.x_max_m});
  config.require("y_m", patch.y_m, Range{area.y_min_m, area.y_max_m});
  patch.z_m = ground_m(config, scenario, patch.x_m, patch.y_m);
  config.require("radius_m", patch.radius_m, Range{0.1, kFar_m});
  config.require("activity_Bq", patch.activity_Bq, Range{1.0, kStrong_Bq});
  return patch;
}

void read_range_sensor(Config& config, RangeSensorConfig& sensor) {
  config.read("range_m", sensor.range_m, {.min = 0.5, .max = 200.0});
  config.read("rays", sensor.rays, {.min = 1, .max = static_cast<int>(kMaxRangePoints)});
  config.read("period_s", sensor.period_s, {.min = 0.01, .max = 10.0});
  constexpr double kStep_s = 0.01;
  if (std::abs(std::remainder(sensor.period_s, kStep_s)) > 1e-9) {
    throw config.error("period_s", fmt::format("is {}, must be a multiple of {}", sensor.period_s, kStep_s));
  }
}

void read_mismatch(Config& config, Mismatch& mismatch) {
  config.read("position_sigma_m", mismatch.position_sigma_m, {.min = 0.0, .max = 10.0});
  config.read("attitude_sigma_rad", mismatch.attitude_sigma_rad, {.min = 0.0, .max = 1.0});
  config.read("pose_correlation_s", mismatch.pose_correlation_s, {.min = 0.1, .max = 1000.0});
  config.read("boresight_sigma_rad", mismatch.boresight_sigma_rad, {.min = 0.0, .max = 1.0});
  config.read("response_sigma", mismatch.response_sigma, {.min = 0.0, .max = 0.3});
  config.read("scatter_share", mismatch.scatter_share, {.min = 0.0, .max = 10.0});
  config.read("dead_time_us", mismatch.dead_time_us, {.min = 0.0, .max = 1e5});
  config.read("background_drift", mismatch.background_drift, {.min = 0.01, .max = 100.0});
  config.read("stray_share", mismatch.stray_share, {.min = 0.0, .max = 1.0});
}

void read_traps(Config& config, Traps& traps) {
  const Range share{0.0, 1.0};
  config.read("epoch_fault_share", traps.epoch_fault_share, share);
  config.read("repeated_pixel_share", traps.repeated_pixel_share, share);
  config.read("tot_zero_share", traps.tot_zero_share, share);
  config.read("hot_pixels", traps.hot_pixels, {.min = 0, .max = 1000});
  config.read("hot_pixel_hits_per_s", traps.hot_pixel_hits_per_s, {.min = 0.0, .max = 1e5});
  config.read("lost_data_per_s", traps.lost_data_per_s, {.min = 0.0, .max = 20.0});
  config.read("lost_data_s", traps.lost_data_s, {.min = 1e-6, .max = 1.0});
  config.read("broken_rows_per_s", traps.broken_rows_per_s, {.min = 0.0, .max = 1e4});
}

Scenario read_scenario(Config& config) {
  Scenario scenario;
  config.require("name", scenario.name);
  config.require("horizon_s", scenario.horizon_s, Range{1.0, 1e5});
  config.section("area", [&](Config& area) { scenario.area = read_area(area); });
  config.read("cell_m", scenario.cell_m, {.min = 0.05, .max = 100.0});
  config.section("world", [&](Config& world) {
    world.read("material", scenario.material, Shield::names());
    scenario.world = read_world(world, scenario.area);
  });
  config.section("known_world", [&](Config& known) {
    bool flat = false;
    known.read("flat", flat);
    scenario.known_world = flat ? World::flat() : read_world(known, scenario.area);
  });
  config.section("mavs", [&](Config& mavs) { read_mavs(mavs, scenario.area, scenario.mavs); });
  config.read("nuclide", scenario.nuclide, {"Cs-137"});
  config.read("more_nuclides", scenario.more_nuclides);
  config.read("air_attenuation_per_m", scenario.air_attenuation_per_m, {.min = 0.0, .max = 1.0});
  config.read("background_singles_per_s", scenario.background_singles_per_s, {.min = 0.0, .max = 1e5});
  config.section("sources_by_seed", [&](Config& draw) { read_draw(draw, scenario, scenario.draw); });
  config.each("sources", [&](Config& source) { scenario.sources.push_back(read_source(source, scenario)); });
  config.section("patch", [&](Config& patch) { scenario.patch = read_patch(patch, scenario); });
  config.section("range_sensor", [&](Config& sensor) { read_range_sensor(sensor, scenario.range_sensor.emplace()); });
  config.section("mismatch", [&](Config& mismatch) { read_mismatch(mismatch, scenario.mismatch); });
  config.section("traps", [&](Config& traps) { read_traps(traps, scenario.traps); });
  for (const char* key : {"area", "mavs"}) {
    if (!config.has(key)) throw config.error(key, "is missing");
  }
  if (!scenario.world.is_flat()) check_starts(config, scenario);
  if (scenario.horizon_s != static_cast<int>(scenario.horizon_s)) {
    throw config.error("horizon_s", fmt::format("{} is not allowed, must be whole seconds", scenario.horizon_s));
  }
  return scenario;
}

}  // namespace

Scenario load_scenario(const std::filesystem::path& file) { return load_config(file, read_scenario); }

}  // namespace comptonaut
