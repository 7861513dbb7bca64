// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "flight/envelope.h"

namespace comptonaut {

/// A shortest-path problem on the grid start + step (i, j, k), each point joined to its 26 neighbours, and the goal to
/// all points nearer than kGoalReach steps, wherever `clear` allows the leg between.
struct GridProblem {
  Eigen::Vector3d start_W;
  Eigen::Vector3d goal_W;
  double step_m = 1.0;
  std::function<bool(const Leg&)> clear;
  std::size_t expanded_max = 50'000;  ///< points after which to give up
  bool both_ways = false;  ///< what is clear is clear the other way, too: then a walled-in goal is soon found to be one
};

/// A little over sqrt(3): wherever the goal lies, the corners of its cell reach it.
inline constexpr double kGoalReach = 1.75;

struct GridAnswer {
  std::optional<std::vector<Eigen::Vector3d>> path;  ///< nullopt: there is none, or not within expanded_max
  std::vector<Eigen::Vector3d> pocket_W;  ///< where the goal turned out to be walled in: all points that lead there
};

/// The shortest path by A* with the distance to the goal as heuristic; ties go to the point found first. Both ways: a
/// search that takes long also looks from the goal how far one gets from there at all.
[[nodiscard]] GridAnswer shortest_grid_path(const GridProblem& problem);

}  // namespace comptonaut
