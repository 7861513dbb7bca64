// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <map>
#include <span>
#include <vector>

#include "search/strategy.h"

namespace comptonaut {

/// What each MAV, by number, has still to visit, in order.
using Targets = std::map<std::int32_t, std::vector<Eigen::Vector3d>>;

/// Takes from the front of `targets` what a MAV that flew along `track_W` came within reach_m of, horizontally, one
/// after another; returns it.
std::vector<Eigen::Vector3d> take_reached(std::vector<Eigen::Vector3d>& targets,
                                          const std::vector<Eigen::Vector3d>& track_W, double reach_m);

/// The configuration, its fence with the known sources that must be kept away from.
[[nodiscard]] SearchConfig with_keep_out(std::span<const SourceEstimate> sources, SearchConfig config);

/// Legs to the targets. Targets where no MAV may be are moved to the nearest place where one may. Each MAV's first leg
/// collides with nothing, with no first leg of a MAV with a lower number and, if such a way leads to the first target,
/// with no place where one of a higher number stands. Where there is no way, the first target that has one is moved to
/// the front, and without any the MAV holds. The legs after it collide with nothing; the course ends before a target
/// that has no way, or where it is 15 s long at full speed. `targets` keeps all.
[[nodiscard]] std::vector<Course> make_courses(const SearchState& state, const SearchConfig& config, Targets& targets);

}  // namespace comptonaut
