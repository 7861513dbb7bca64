// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/cells.h"
#include "nodes/terrain_config.h"
#include "radiation/joint_config.h"
#include "radiation/mlem_config.h"
#include "response/cone_density.h"
#include "search/search_config.h"

namespace comptonaut {

class Config;

/// A plan's datagram has room to name so many senders.
inline constexpr int kMaxTeam = 15;

inline const std::vector<std::string> kEstimators = {"mlem", "joint"};

/// A team's coordinator. The same file on every machine of a team; `machine` is the daemon's --mav.
struct CoordinatorConfig {
  std::int64_t mission = 1;           ///< batches of another mission are refused
  std::int32_t machine = 0;           ///< where it runs: MAV number, 0 for the ground station
  std::vector<int> mavs = {1, 2, 3};  ///< numbers of the team; batches of others are refused
  std::string nuclide = "Cs-137";
  std::filesystem::path response_table;    ///< of that nuclide
  std::filesystem::path cone_density;      ///< of that nuclide's pairs, for the estimator "joint"
  std::vector<std::string> more_nuclides;  ///< besides, by rising line; their tables: load_more_nuclides
  TerrainConfig terrain;
  double obstacle_attenuation_per_m = 17.9;  ///< of the nuclide's line in them: concrete
  Area area{.x_min_m = 0.0, .x_max_m = 50.0, .y_min_m = 0.0, .y_max_m = 50.0};
  double cell_m = 0.5;
  double speed_max_m_s = 8.0;  ///< of every leg
  double acceleration_max_m_s2 = 3.6;
  double corner_deviation_max_m = 0.25;   ///< by which MAVs cut corners
  double fence_margin_m = 10.0;           ///< plans stay so near to the area, unless search.route.fence has a border
  double endurance_s = 0.0;               ///< that a MAV can fly from when it is first seen; 0: not watched
  double reserve_s = 30.0;                ///< of it, with which it must be back where it was first seen
  double battery_reserve_percent = 20.0;  ///< as its autopilot tells it, with which it must be back; 0: not watched
  double gap_give_up_s = 3.0;             ///< a missing batch is given up when the team's data are so much newer
  double map_period_s = 1.0;              ///< the whole map is published so often
  double lease_s = 3.0;                   ///< the lead ends so long after its last message
  int plan_waypoints_max = 16;      ///< what fits a datagram; the rest of a long list follows as the first are reached
  std::string estimator = "joint";  ///< one of kEstimators
  JointConfig joint;
  MlemConfig mlem;
  SearchConfig search;
};

[[nodiscard]] CoordinatorConfig read_coordinator_config(Config& config);

/// Where MAVs may be: the configured fence; without one, the area and fence_margin_m around it.
[[nodiscard]] Fence fence_of(const CoordinatorConfig& config);

/// The file `cone_density`; nullopt where none is named. Throws std::runtime_error with file, line and reason.
[[nodiscard]] std::optional<ConeDensity> load_cone_density(const CoordinatorConfig& config);

}  // namespace comptonaut
