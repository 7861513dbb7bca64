// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "nodes/coordinator_config.h"
#include "nodes/pose_bridge.h"
#include "sim/scenario.h"

namespace comptonaut {

/// What flights are planned with: a tenth of what the vehicles can is left to their control. One that is told to brake
/// as fast as it can comes to stand behind the place, by 0.8 m at 8 m/s.
[[nodiscard]] double planned_acceleration_m_s2(const ScenarioMavs& mavs);

/// Fits a team's coordinator to a scenario: area, cells, MAVs, speed and height, and what obstacles take of the line of
/// its response table. Throws std::runtime_error that names the table where it is asked for its line and has none.
void fit_to(const Scenario& scenario, CoordinatorConfig& coordinator);

/// The same for its file: YAML text, with paths made absolute so that it may stand in another folder. `octomap` is
/// where the team's map is written, unless that is flat. Throws ConfigError.
[[nodiscard]] std::string fitted_coordinator_yaml(const Scenario& scenario, const std::filesystem::path& file,
                                                  const std::filesystem::path& octomap);

/// Likewise for the drones' mapper: the team's map, which range points are held against.
[[nodiscard]] std::string fitted_mapper_yaml(const Scenario& scenario, const std::filesystem::path& file,
                                             const std::filesystem::path& octomap);

/// Likewise for the drones' pose-bridge: speed, acceleration, and nobody steps aside where there are obstacles.
void fit_to(const Scenario& scenario, PoseBridgeConfig& bridge);
[[nodiscard]] std::string fitted_pose_bridge_yaml(const Scenario& scenario, const std::filesystem::path& file);

}  // namespace comptonaut
