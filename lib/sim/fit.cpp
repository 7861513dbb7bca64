// SPDX-License-Identifier: BSD-3-Clause
#include "sim/fit.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

#include "config/config.h"
#include "config/overlay.h"
#include "nodes/mapper_config.h"
#include "physics/shield.h"
#include "response/response_table.h"

namespace comptonaut {

namespace {

/// Of the nuclide that the table is of.
double line_keV(const std::filesystem::path& response_table) {
  const ResponseTable table = ResponseTable::load(response_table);
  const auto line = table.facts().find("line_keV");
  if (line == table.facts().end()) {
    throw std::runtime_error(fmt::format(
        "{}: names no line_keV, which obstacles ask for; 'comptonaut response' writes it", response_table.string()));
  }
  return std::stod(line->second);
}

/// The scenario ends with the batteries' reserve: the team is home so much earlier, unless MAVs wait for each other.
constexpr double kHomeBefore_s = 5.0;

/// A MAV that returns without a plan flies so much above the highest roof.
constexpr double kAboveRoofs_m = 1.5;

double top_m(const Scenario& scenario) {
  const Cells cells = scenario.world.surface_cells(scenario.area, scenario.cell_m);
  double highest_m = 0.0;
  for (std::size_t j = 0; j < cells.size(); ++j) highest_m = std::max(highest_m, cells.p_W(j).z());
  return highest_m;
}

std::string quoted(const std::filesystem::path& path) {
  return fmt::format("\"{}\"", std::filesystem::absolute(path).lexically_normal().string());
}

}  // namespace

double planned_acceleration_m_s2(const ScenarioMavs& mavs) { return 0.9 * mavs.acceleration_max_m_s2; }

void fit_to(const Scenario& scenario, CoordinatorConfig& coordinator) {
  coordinator.area = scenario.area;
  coordinator.cell_m = scenario.cell_m;
  coordinator.terrain.ground_m = 0.0;
  coordinator.nuclide = scenario.nuclide;
  if (!scenario.world.is_flat()) {
    coordinator.obstacle_attenuation_per_m =
        Shield::load(scenario.material).attenuation_per_m(line_keV(coordinator.response_table));
  }
  coordinator.more_nuclides = scenario.more_nuclides;
  coordinator.speed_max_m_s = scenario.mavs.speed_max_m_s;
  coordinator.acceleration_max_m_s2 = planned_acceleration_m_s2(scenario.mavs);
  coordinator.search.set_height_m = scenario.mavs.height_m;
  if (scenario.draw.count > 0) {
    coordinator.joint.activity_min_Bq = scenario.draw.activity_min_Bq;
    coordinator.joint.activity_max_Bq = scenario.draw.activity_max_Bq;
  }
  coordinator.endurance_s = std::max(1.0, scenario.horizon_s - kHomeBefore_s) + coordinator.reserve_s;
  coordinator.mavs.clear();
  for (int mav = 1; mav <= scenario.mavs.count; ++mav) coordinator.mavs.push_back(mav);
}

void fit_to(const Scenario& scenario, PoseBridgeConfig& bridge) {
  bridge.pilot.limits.speed_max_m_s = scenario.mavs.speed_max_m_s;
  bridge.pilot.limits.acceleration_max_m_s2 = planned_acceleration_m_s2(scenario.mavs);
  if (scenario.world.is_flat()) return;
  bridge.pilot.separation.step_aside_after_s = 0.0;  // it sees no obstacles
  bridge.pilot.return_z_m = top_m(scenario) + kAboveRoofs_m;
}

std::string fitted_pose_bridge_yaml(const Scenario& scenario, const std::filesystem::path& file) {
  PoseBridgeConfig fitted = load_config(file, read_pose_bridge_config);
  fit_to(scenario, fitted);
  const auto number = [](double value) { return fmt::format("{}", value); };
  return overlaid(file, {{{"limits", "speed_max_m_s"}, number(fitted.pilot.limits.speed_max_m_s)},
                         {{"limits", "acceleration_max_m_s2"}, number(fitted.pilot.limits.acceleration_max_m_s2)},
                         {{"return_z_m"}, number(fitted.pilot.return_z_m)},
                         {{"separation", "step_aside_after_s"}, number(fitted.pilot.separation.step_aside_after_s)}});
}

std::string fitted_mapper_yaml(const Scenario& scenario, const std::filesystem::path& file,
                               const std::filesystem::path& octomap) {
  (void)load_config(file, read_mapper_config);
  std::vector<ConfigOverride> overrides = {{{"ground_m"}, "0"}};
  if (!scenario.team_world().is_flat()) overrides.push_back({{"octomap"}, quoted(octomap)});
  return overlaid(file, overrides);
}

std::string fitted_coordinator_yaml(const Scenario& scenario, const std::filesystem::path& file,
                                    const std::filesystem::path& octomap) {
  CoordinatorConfig fitted = load_config(file, read_coordinator_config);
  fit_to(scenario, fitted);
  const Area& area = fitted.area;
  std::vector<ConfigOverride> overrides = {
      {{"area"},
       fmt::format("{{x_min_m: {}, x_max_m: {}, y_min_m: {}, y_max_m: {}}}", area.x_min_m, area.x_max_m, area.y_min_m,
                   area.y_max_m)},
      {{"cell_m"}, fmt::format("{}", fitted.cell_m)},
      {{"ground_m"}, fmt::format("{}", fitted.terrain.ground_m)},
      {{"nuclide"}, fitted.nuclide},
      {{"more_nuclides"}, fmt::format("[{}]", fmt::join(fitted.more_nuclides, ", "))},
      {{"speed_max_m_s"}, fmt::format("{}", fitted.speed_max_m_s)},
      {{"acceleration_max_m_s2"}, fmt::format("{}", fitted.acceleration_max_m_s2)},
      {{"endurance_s"}, fmt::format("{}", fitted.endurance_s)},
      {{"mavs"}, fmt::format("[{}]", fmt::join(fitted.mavs, ", "))},
      {{"search", "set_height_m"}, fmt::format("{}", fitted.search.set_height_m)},
      {{"joint", "activity_min_Bq"}, fmt::format("{}", fitted.joint.activity_min_Bq)},
      {{"joint", "activity_max_Bq"}, fmt::format("{}", fitted.joint.activity_max_Bq)},
      {{"response_table"}, quoted(fitted.response_table)}};
  if (!fitted.cone_density.empty()) overrides.push_back({{"cone_density"}, quoted(fitted.cone_density)});
  if (!scenario.team_world().is_flat()) overrides.push_back({{"octomap"}, quoted(octomap)});
  if (!scenario.world.is_flat()) {
    overrides.push_back({{"obstacle_attenuation_per_m"}, fmt::format("{}", fitted.obstacle_attenuation_per_m)});
  }
  return overlaid(file, overrides);
}

}  // namespace comptonaut
