// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/time.h"
#include "flight/route.h"
#include "flight/slots.h"

namespace comptonaut {

struct TeamFlightConfig {
  MotionLimits limits;
  double slot_s = 0.2;            ///< how much two MAVs may be early or late against each other
  double horizon_s = 8.0;         ///< so much of a course is checked, and braking at its end
  double off_course_max_m = 2.0;  ///< a MAV farther from where it should be has fallen behind
};

/// One MAV and where it is to go.
struct Flyer {
  std::int32_t mav = 0;
  Motion now;                             ///< its acceleration is not used
  std::vector<Eigen::Vector3d> course_W;  ///< in straight legs; none: stop
  bool lost = false;                      ///< not heard of: it gets no plan and is kept away from
};

/// What one MAV is told.
struct Flight {
  std::vector<Waypoint> waypoints;  ///< each with the time when it should be reached; none: hold
  std::string status;               ///< in words, who is too near, what keeps it from its course; empty: nothing
};

/// Makes courses flyable: each MAV's flight stays inside the fence, clear of closed space, and separated in space and
/// time from those of all others, at all times until it rests.
///
/// MAVs come one after another, the first has priority. Each takes as much of its course as keeps apart from the new
/// flights of those before it and from what those after it fly already, and from where each of them stands if it brakes
/// at once: nobody counts on another one to leave. Where that is not all, it stops short and waits, and where there is
/// nothing at all it goes on with what it flew before. That was apart from everybody's, so if MAVs fly as told no tick
/// can bring two together. One that has fallen behind, or has an obstacle or fence before it that was not there when
/// its flight was made, is taken to brake where it is, and all others keep away from that, as far as they can still
/// stop; what they cannot is left to the last-line separation.
class TeamFlight {
 public:
  explicit TeamFlight(const TeamFlightConfig& config) : config_(config) {}

  /// One flight per flyer, in their order. Deterministic: what it says depends on what it was shown, tick by tick.
  [[nodiscard]] std::vector<Flight> plan(const World& world, const RouteConfig& route, std::span<const Flyer> flyers,
                                         Utime utime);

 private:
  struct Committed {
    Trajectory trajectory;
    std::vector<Waypoint> waypoints;  ///< of the trajectory
    std::vector<Waypoint> told;       ///< to the MAV: they may lead on, where planning anew will come before that
    Utime utime = 0;                  ///< when it began
  };
  /// A flight that is thought of.
  struct Candidate {
    Committed flight;
    Slots slots;
    std::size_t passed = 0;  ///< of the waypoints
  };
  struct Scene;

  [[nodiscard]] Candidate candidate(const Flyer& flyer, std::span<const Eigen::Vector3d> course_W, Utime utime) const;
  [[nodiscard]] bool leads_off(const Candidate& rest, const Flyer& flyer, const World& world, const RouteConfig& route,
                               Utime utime) const;
  [[nodiscard]] Candidate going_on(const Flyer& flyer, Utime utime) const;
  [[nodiscard]] std::vector<Candidate> all_going_on(const World& world, const RouteConfig& route,
                                                    std::span<const Flyer> flyers, Utime utime) const;
  [[nodiscard]] Slots late(const Flyer& flyer, std::span<const Eigen::Vector3d> course_W, Utime utime) const;
  [[nodiscard]] std::optional<Candidate> new_flight(const Scene& scene, const Flyer& flyer, std::string& status) const;
  [[nodiscard]] std::optional<Candidate> checked_rest(const Scene& scene, const Flyer& flyer) const;

  TeamFlightConfig config_;
  std::map<std::int32_t, Committed> committed_;
};

}  // namespace comptonaut
