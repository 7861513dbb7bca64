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
  std::size_t expanded_max = 0;  ///< points after which to give up
};

/// A little over sqrt(3): wherever the goal lies, the corners of its cell reach it.
inline constexpr double kGoalReach = 1.75;

/// The shortest path by A* with the distance to the goal as heuristic; ties go to the point found first.
[[nodiscard]] std::optional<std::vector<Eigen::Vector3d>> shortest_grid_path(const GridProblem& problem);

}  // namespace comptonaut
