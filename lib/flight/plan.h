// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "core/batch_key.h"
#include "core/time.h"

namespace comptonaut {

/// One point of a plan, reached in a straight line from the point before.
struct Waypoint {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  ///< m
  double speed_max_m_s = 0.0;                     ///< on the leg to it
  Utime utime = 0;                                ///< when it should be reached; 0: as soon as the limits allow

  bool operator==(const Waypoint&) const = default;
};

/// What one MAV flies until the next plan comes. No waypoints: hold.
struct Plan {
  std::int64_t mission = 0;
  Utime utime = 0;  ///< tick that it was made at
  std::int32_t mav = 0;
  std::int64_t term = 0;    ///< of the coordinator that made it
  std::int64_t number = 0;  ///< grows with each plan for this MAV within a term
  Basis basis;              ///< of each sender its newest boot epoch; all of it is in the tick's COORDINATOR
  std::string status;       ///< in words
  std::vector<Waypoint> waypoints;
};

}  // namespace comptonaut
