// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "world/world.h"

namespace comptonaut {

/// An upright ellipsoid about a MAV that must stay clear: taller than wide, because of the down-wash.
struct Envelope {
  double radius_m = 0.6;
  double half_height_m = 1.0;
};

/// A straight flight between two points of frame W. The two may be the same.
struct Leg {
  Eigen::Vector3d from_W = Eigen::Vector3d::Zero();
  Eigen::Vector3d to_W = Eigen::Vector3d::Zero();
};

/// The collision checks are safe by this much: what is nearer than that counts as a hit.
inline constexpr double kCollisionTolerance_m = 1e-3;

/// The smallest axis-aligned box about all that the envelope sweeps along the leg.
[[nodiscard]] Box bounds(const Envelope& envelope, const Leg& leg);

/// Whether the envelope meets the box anywhere along the leg.
[[nodiscard]] bool sweep_meets(const Envelope& envelope, const Leg& leg, const Box& box);

/// Whether the envelope, moved along leg a, meets any place of leg b: two MAVs whose centres must be apart by the
/// envelope's radius (sideways) or half height (up and down) may each be anywhere on its leg.
[[nodiscard]] bool sweep_meets(const Envelope& envelope, const Leg& a, const Leg& b);

}  // namespace comptonaut
