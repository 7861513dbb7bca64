// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "flight/route.h"
#include "search/coarse_ground.h"

namespace comptonaut {

/// Per square of the ground: where above it a MAV may hover, in its middle if possible; nullopt: nowhere.
using HoverPlaces = std::vector<std::optional<Eigen::Vector3d>>;

/// At set_height_m above each square, as far from obstacles as ways keep; in an alley narrower than a square that is
/// beside the middle. What it costs is some looks at the world per square: little where it is open.
[[nodiscard]] HoverPlaces hover_places(const CoarseGround& ground, const World& world, const RouteConfig& route,
                                       double set_height_m);

}  // namespace comptonaut
