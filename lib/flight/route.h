// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/cells.h"
#include "flight/envelope.h"
#include "world/world.h"

namespace comptonaut {

/// Where a MAV's centre may be.
struct Fence {
  Area area{.x_min_m = -1e4, .x_max_m = 1e4, .y_min_m = -1e4, .y_max_m = 1e4};
  double floor_m = -1e4;   ///< z in W
  double ceiling_m = 1e4;  ///< z in W

  [[nodiscard]] bool contains(const Eigen::Vector3d& p_W) const {
    return area.contains(p_W.x(), p_W.y()) && p_W.z() >= floor_m && p_W.z() <= ceiling_m;
  }
};

struct RouteConfig {
  Envelope envelope;                                           ///< stays clear of closed space
  Envelope separation{.radius_m = 3.0, .half_height_m = 4.0};  ///< centres of two MAVs stay so far apart
  Fence fence;
  double step_m = 1.0;                ///< of the search grid
  std::size_t expanded_max = 50'000;  ///< grid points after which the search gives up
};

/// Whether a flight along `leg` stays apart from one along `other`. One that begins nearer must not get nearer still.
[[nodiscard]] bool keeps_apart(const Envelope& separation, const Leg& leg, const Leg& other);

/// A way from start to goal that keeps the envelope clear of closed space along the whole of each leg, stays inside
/// the fence, and keeps its distance from the legs that other MAVs have taken: the straight line where that is clear,
/// else A* [Hart, Nilsson, Raphael 1968] on a grid about the start (26 neighbours), shortened. The answer begins with
/// `start` and ends with `goal`. nullopt: there is no way on this grid.
///
/// A start outside the fence is allowed, so that a MAV can come back. One that is nearer to a taken leg than the
/// separation must not get nearer to it, so that a MAV can get out.
[[nodiscard]] std::optional<std::vector<Eigen::Vector3d>> find_route(const World& world, const RouteConfig& config,
                                                                     const Eigen::Vector3d& start_W,
                                                                     const Eigen::Vector3d& goal_W,
                                                                     std::span<const Leg> taken = {});

}  // namespace comptonaut
