// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "world/world.h"

namespace comptonaut {

/// What a town is made of.
struct TownPlan {
  std::uint64_t seed = 1;
  double x_m = 60.0, y_m = 60.0, z_m = 15.0;  ///< of the area from the origin, and up to where MAVs may fly
  int buildings = 8;
  int sources = 4;  ///< half of them behind walls
  int drones = 3;
};

/// Houses, yards with walls on three sides and lone walls, kStreet_m apart, and clear of the south side where MAVs
/// begin; edges on whole half metres. Throws std::invalid_argument where the numbers or lengths are out of range,
/// std::runtime_error where so many buildings find no room.
[[nodiscard]] std::vector<Box> town_boxes(const TownPlan& plan);

/// Its scenario, YAML, with the buildings as boxes. Throws as town_boxes does.
[[nodiscard]] std::string town_yaml(const TownPlan& plan, const std::string& name);

inline constexpr double kStreet_m = 5.0;

}  // namespace comptonaut
