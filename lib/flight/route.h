// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "flight/envelope.h"
#include "flight/fence.h"
#include "world/world.h"

namespace comptonaut {

struct RouteConfig {
  Envelope envelope;      ///< stays clear of closed space,
  double margin_m = 0.0;  ///< ways by so much more: corners are cut, plans come late
  Envelope separation{.radius_m = 3.0, .half_height_m = 4.0};  ///< centres of two MAVs stay so far apart
  Fence fence;
  double step_m = 1.0;                ///< of the search grid
  std::size_t expanded_max = 50'000;  ///< grid points after which the search gives up
};

/// Whether the envelope meets closed space anywhere along the leg.
[[nodiscard]] bool meets_closed(const World& world, const Envelope& envelope, const Leg& leg);

/// Whether closed space leaves a MAV that stays at p_W its envelope and margin.
[[nodiscard]] bool may_hover(const World& world, const RouteConfig& config, const Eigen::Vector3d& p_W);

/// The envelope where it is clear of closed space at p_W; else as much of it as is, in steps, so that a MAV can get
/// away. Down to a twentieth, which is not clear where the MAV's middle is in closed space.
[[nodiscard]] Envelope kept_envelope(const World& world, Envelope envelope, const Eigen::Vector3d& p_W);

/// How much of the separation a MAV at p_W must keep from `other`: all of it, 1, or if it is nearer already a hair less
/// than it has, so that it can get away; not positive where nothing can be kept.
[[nodiscard]] double kept_share(const Envelope& separation, const Eigen::Vector3d& p_W, const Leg& other);

/// Whether a flight along `leg` stays apart from one along `other`. One that begins nearer must not get nearer still.
[[nodiscard]] bool keeps_apart(const Envelope& separation, const Leg& leg, const Leg& other);

/// A way from start to goal that keeps the envelope clear of closed space along the whole of each leg, stays inside
/// the fence, and keeps its distance from the legs that other MAVs have taken: the straight line where that is clear,
/// else A* [Hart, Nilsson, Raphael 1968] on a grid about the start (26 neighbours), shortened. Far or well hidden goals
/// are looked for on a grid four times as wide first; such a way may be somewhat longer than the shortest. The answer
/// begins with `start` and ends with `goal`. nullopt: there is no way on this grid.
///
/// A start outside the fence is allowed, so that a MAV can come back. One that is nearer to a taken leg than the
/// separation must not get nearer to it, so that a MAV can get out; likewise one that is nearer to closed space than
/// the margin or the envelope, as long as its middle is not in it.
[[nodiscard]] std::optional<std::vector<Eigen::Vector3d>> find_route(const World& world, const RouteConfig& config,
                                                                     const Eigen::Vector3d& start_W,
                                                                     const Eigen::Vector3d& goal_W,
                                                                     std::span<const Leg> taken = {});

/// Why find_route found none, whatever ways were taken.
struct NoRoute {
  std::string why;             ///< in words: "it is outside the fence", "other MAVs are in the way", ...
  bool without_others = true;  ///< nor would there be one if nobody else were there
  std::vector<Eigen::Vector3d> pocket_W = {};  ///< of a goal that is walled in: the places that are so with it
};

[[nodiscard]] NoRoute why_no_route(const World& world, const RouteConfig& config, const Eigen::Vector3d& start_W,
                                   const Eigen::Vector3d& goal_W);

}  // namespace comptonaut
