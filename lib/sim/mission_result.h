// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/time.h"
#include "nodes/truth.h"
#include "sim/judgement.h"

namespace comptonaut {

/// What all detectors of the team reported.
struct EventTally {
  std::int64_t singles = 0;
  std::int64_t pairs = 0;
  std::int64_t others = 0;

  [[nodiscard]] std::int64_t all() const { return singles + pairs + others; }
};

/// Where a MAV truly was, every kTrackPeriod_us from the start on.
using TrueTrack = std::vector<Eigen::Vector3f>;
inline constexpr Utime kTrackPeriod_us = 200'000;

struct MissionResult {
  std::uint64_t seed = 0;
  std::vector<TrueSource> sources;
  std::vector<TrueTrack> tracks;  ///< one per MAV
  std::vector<Judgement> steps;   ///< one per simulated second, from 1 s to the horizon
  EventTally events;
  double distance_min_m = 0.0;  ///< between two MAVs, ever
  double outside_s = 0.0;       ///< that MAVs spent outside the fence or above excluded areas, summed up
  int at_home = 0;              ///< MAVs that ended where they began
  int collisions = 0;           ///< with obstacles
  double cpu_s = 0.0;           ///< processor time that the run took
};

}  // namespace comptonaut
