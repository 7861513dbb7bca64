// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "flight/trajectory.h"

namespace comptonaut {

/// One straight leg of a trajectory, between two waypoints.
struct StraightLeg {
  Eigen::Vector3d from_W;
  Eigen::Vector3d direction;
  double length_m;
  double speed_max_m_s;
  std::size_t waypoint;  ///< that it leads to
};

/// Speeds along a trajectory: its start manoeuvre, then legs, each between two corners. At a corner the velocity turns
/// from one leg to the other at constant acceleration.
struct Profile {
  Motion start;          ///< with the acceleration of the start manoeuvre
  double start_s = 0.0;  ///< that it takes
  std::vector<StraightLeg> legs;
  std::vector<double> speeds_m_s;  ///< [i] where leg i begins; the last one: 0, where the last leg ends
};

/// Where `motion` leads in dt_s at constant acceleration.
[[nodiscard]] Motion after(const Motion& motion, double dt_s);

/// Way that a corner's blend takes along each of its two legs, m: v^2 |e2 - e1| / (2 a). 0 at both ends of the flight.
[[nodiscard]] double blend_m(const Profile& profile, std::size_t corner, double acceleration_m_s2);

/// The fastest profile whose start manoeuvre ends with `start_speed_m_s` towards the first waypoint.
/// nullopt: there is none within the limits. With 0 there always is one.
[[nodiscard]] std::optional<Profile> profile_from(const Motion& now, std::span<const Waypoint> waypoints,
                                                  const MotionLimits& limits, double start_speed_m_s);

}  // namespace comptonaut
