// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>

#include "core/pose.h"
#include "flight/trajectory.h"

namespace comptonaut {

/// When a MAV stops for another one, whatever its plan says. Distances count height differences at `height_weight`,
/// less than fully, because of the down-wash.
struct SeparationConfig {
  double distance_min_m = 2.0;    ///< no MAV comes nearer to another one than this
  double give_way_extra_m = 1.0;  ///< a MAV gives way that much earlier to one of a lower number
  double release_extra_m = 0.5;   ///< and goes on only with that much more
  double reaction_s = 0.5;        ///< flown on before braking, in the prediction
  double speed_margin_s = 0.3;    ///< more distance per m/s of both speeds: the other one may turn
  double pose_age_max_s = 2.0;    ///< after which another MAV's pose says nothing
  double height_weight = 0.7;
  /// A MAV that has stood so long for one of a lower number moves sideways out of the way; 0: never. It sees no
  /// obstacles then: for open ground only.
  double step_aside_after_s = 3.0;
};

/// Where the other MAVs were last seen, by number, in this MAV's time.
using Others = std::map<int, StampedPose>;

/// What one MAV is about to do.
struct Intent {
  int mav = 0;
  Utime utime = 0;  ///< now
  const Trajectory& trajectory;
  double t_s = 0.0;         ///< now, on the trajectory
  bool giving_way = false;  ///< stands already, or brakes
  bool aside = false;       ///< the trajectory leads out of the way
};

/// The MAV to stop for: if this one goes on for the reaction time and then brakes in a straight line, the distance to
/// the other one falls below the limit, and stopping at once is no worse (for one that stands or steps aside: better).
/// One that gets away from the other all the while goes on.
/// Of one with a lower number it assumes that it flies straight on, of one with a higher number that it does as this
/// one; so the higher number stops first, and the lower one only where that is not enough. nullopt: go on.
[[nodiscard]] std::optional<int> must_stop_for(const Intent& intent, const Others& others,
                                               const SeparationConfig& config, double acceleration_max_m_s2);

}  // namespace comptonaut
