// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/cells.h"
#include "flight/envelope.h"

namespace comptonaut {

/// Corners in the horizontal plane of W, m, in order round it; it may have dents, its edges must not cross. Its border
/// belongs to it.
using Polygon = std::vector<Eigen::Vector2d>;

/// Whether no two of its edges cross or touch, but for neighbours at their corner.
[[nodiscard]] bool is_simple(const Polygon& polygon);

[[nodiscard]] Polygon polygon_of(const Area& area, double margin_m = 0.0);
[[nodiscard]] bool contains(const Polygon& polygon, const Eigen::Vector2d& p_W);

/// A disc over which nobody flies, m.
struct Disc {
  Eigen::Vector2d p_W = Eigen::Vector2d::Zero();
  double radius_m = 0.0;
};

/// Where a MAV's centre may be.
struct Fence {
  Polygon border;                          ///< empty: anywhere
  double floor_m = -1e4, ceiling_m = 1e4;  ///< z in W
  std::vector<Polygon> excluded;           ///< not above these
  std::vector<Disc> keep_out;              ///< nor above these

  [[nodiscard]] bool contains(const Eigen::Vector3d& p_W) const;
  /// Between floor and ceiling and inside the border, whatever is excluded there.
  [[nodiscard]] bool within_border(const Eigen::Vector3d& p_W) const;

  /// Whether the whole leg stays where a MAV may be. One that begins elsewhere leads back: it comes nearer, and what it
  /// has reached it does not leave again.
  [[nodiscard]] bool allows(const Leg& leg) const;

  /// The nearest place, horizontally, that is a hand's breadth out of the excluded areas and discs; p_W itself where
  /// that is allowed. Where they overlap, or at the border, it may still not be allowed.
  [[nodiscard]] Eigen::Vector3d nearest_allowed(const Eigen::Vector3d& p_W) const;
};

}  // namespace comptonaut
