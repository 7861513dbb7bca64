// SPDX-License-Identifier: BSD-3-Clause
#include "flight/team_flight.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/segment.h"

namespace comptonaut {
namespace {

/// Of the horizon: how much of a course is tried, the most first.
constexpr std::array<double, 5> kTried = {1.0, 0.7, 0.45, 0.25, 0.12};

/// The course up to where it leads in t_s.
std::vector<Eigen::Vector3d> cut(const Flyer& flyer, const Trajectory& whole, double t_s) {
  const auto& course_W = flyer.course_W;
  if (t_s >= whole.duration_s()) return course_W;
  const std::size_t to = std::min(whole.waypoint_at(t_s), course_W.size() - 1);
  std::vector<Eigen::Vector3d> points_W(course_W.begin(), course_W.begin() + static_cast<std::ptrdiff_t>(to));
  const Eigen::Vector3d& from_W = to > 0 ? course_W[to - 1] : flyer.now.p_W;
  points_W.push_back(nearest_on<3>(from_W, course_W[to], whole.sample(t_s).p_W));
  return points_W;
}

/// Way on which a MAV that is too near to an obstacle gets away from it.
constexpr double kGetsAway_m = 2.5;  // a step of the grid, and a corner

/// A plan is made for where MAVs were seen, and they fly it at most so much later: in simulation 0.15 s, poses and the
/// vehicle's lag included.
constexpr double kLate_s = 0.25;

/// Before what was checked is over, a MAV that was told more is told to stop at its end: from when on it is, as soon as
/// that does not change how it turns, and by when at the latest.
constexpr double kStops_s = 5.0;
constexpr double kStopsAtLatest_s = 2.5;

/// Whether a MAV that is told of the whole course flies as was checked until it is told anew: a longer course may be
/// quicker with another turn at its start.
bool begin_alike(const Trajectory& whole, const Trajectory& checked) {
  constexpr double kToldAnew_s = 1.5, kStep_s = 0.1, kAlike_m = 0.01;
  for (double t_s = 0.0; t_s <= kToldAnew_s; t_s += kStep_s) {
    if ((whole.sample(t_s).p_W - checked.sample(t_s).p_W).norm() > kAlike_m) return false;
  }
  return true;
}

Trajectory trajectory_of(const Flyer& flyer, std::span<const Eigen::Vector3d> course_W, const MotionLimits& limits) {
  std::vector<Waypoint> waypoints;
  for (const Eigen::Vector3d& p_W : course_W) waypoints.push_back({.p_W = p_W});
  return {flyer.now.p_W, flyer.now.v_W, waypoints, limits};
}

/// Where a flight leads after t_s of it.
std::vector<Eigen::Vector3d> still_ahead(const Trajectory& trajectory, std::span<const Waypoint> waypoints,
                                         double t_s) {
  std::vector<Eigen::Vector3d> points_W;
  for (const Waypoint& waypoint : waypoints.subspan(trajectory.waypoint_at(t_s))) points_W.push_back(waypoint.p_W);
  return points_W;
}

std::vector<Waypoint> stamped(std::span<const Eigen::Vector3d> course_W, const Trajectory& trajectory,
                              double speed_max_m_s, Utime utime) {
  std::vector<Waypoint> waypoints;
  for (std::size_t i = 0; i < course_W.size(); ++i) {
    waypoints.push_back(
        {.p_W = course_W[i], .speed_max_m_s = speed_max_m_s, .utime = utime + microseconds(trajectory.arrival_s(i))});
  }
  return waypoints;
}

/// Whether the fence allows a leg and what is spare_m beside it; of a negative one, whether it allows any of these.
bool allows(const Fence& fence, const Leg& leg, double spare_m) {
  const Eigen::Vector3d along = leg.to_W - leg.from_W;
  const Eigen::Vector3d aside = spare_m * Eigen::Vector3d(-along.y(), along.x(), 0.0).normalized();
  const auto allowed = [&](double share) {
    return fence.allows({leg.from_W + share * aside, leg.to_W + share * aside});
  };
  if (spare_m < 0.0) return allowed(0.0) || allowed(1.0) || allowed(-1.0);
  return allowed(0.0) && allowed(1.0) && allowed(-1.0);
}

/// In words what is in the way of a flight besides other MAVs, at most spare_m beside it; empty: nothing.
std::string obstacle_to(const Slots& slots, const World& world, const RouteConfig& route, double spare_m) {
  Envelope wide = route.envelope;
  wide.radius_m += spare_m;
  wide.half_height_m += spare_m;
  const Eigen::Vector3d& start_W = slots.legs.front().from_W;
  const bool too_near = meets_closed(world, route.envelope, {start_W, start_W});
  const Envelope at_first = too_near ? kept_envelope(world, route.envelope, start_W) : wide;
  for (const Leg& leg : slots.legs) {
    if (!allows(route.fence, leg, spare_m)) return "stopping before the fence";
    const bool gets_away = (leg.to_W - start_W).norm() <= kGetsAway_m;
    if (meets_closed(world, gets_away ? at_first : wide, leg)) return "stopping before an obstacle";
  }
  return "";
}

}  // namespace

/// What a new flight of one MAV must keep away from.
struct TeamFlight::Scene {
  const World& world;
  const RouteConfig& route;
  std::span<const Flyer> flyers;
  std::span<const Candidate> flights;  ///< of all flyers: new ones, and what they fly already
  std::span<const Slots> brakes;       ///< of all flyers: where they stand if they brake at once
  std::size_t me = 0;
  Utime utime = 0;

  /// In words which MAV is in the way of a flight; empty: none.
  [[nodiscard]] std::string other_mav(const Slots& slots) const {
    for (std::size_t i = 0; i < flights.size(); ++i) {
      if (i == me) continue;
      if (!keep_apart(route.separation, slots, brakes[i]) || !keep_apart(route.separation, slots, flights[i].slots)) {
        return fmt::format("waiting for MAV {}", flyers[i].mav);
      }
    }
    return "";
  }

  /// In words which MAV is nearer than the separation already, and what is done about it; empty: none.
  [[nodiscard]] std::string too_near(const Flight& flight) const {
    const Eigen::Vector3d& p_W = flyers[me].now.p_W;
    const auto near = std::ranges::find_if(flyers, [&](const Flyer& other) {
      const Leg there{.from_W = other.now.p_W, .to_W = other.now.p_W};
      return &other != &flyers[me] && kept_share(route.separation, p_W, there) < 1.0;
    });
    if (near == flyers.end()) return "";
    return fmt::format("too near to MAV {}: {}", near->mav, flight.waypoints.empty() ? "holding" : "getting away");
  }
};

TeamFlight::Candidate TeamFlight::candidate(const Flyer& flyer, std::span<const Eigen::Vector3d> course_W,
                                            Utime utime) const {
  Candidate result{
      .flight = {.trajectory = trajectory_of(flyer, course_W, config_.limits), .waypoints = {}, .utime = utime},
      .slots = {}};
  const Trajectory& trajectory = result.flight.trajectory;
  result.flight.waypoints = stamped(course_W, trajectory, config_.limits.speed_max_m_s, utime);
  result.flight.told = result.flight.waypoints;
  result.slots = slots_of(trajectory, 0.0, config_.slot_s, config_.limits.acceleration_max_m_s2);
  return result;
}

/// The rest of what the MAV was told, as long as it is where it should be; else it brakes.
TeamFlight::Candidate TeamFlight::going_on(const Flyer& flyer, Utime utime) const {
  const auto committed = committed_.find(flyer.mav);
  if (committed == committed_.end()) return candidate(flyer, {}, utime);
  const auto& [trajectory, waypoints, told, begin] = committed->second;
  const double t_s = seconds(utime - begin);
  if ((trajectory.sample(t_s).p_W - flyer.now.p_W).norm() > config_.off_course_max_m)
    return candidate(flyer, {}, utime);
  Candidate rest{.flight = committed->second,
                 .slots = slots_of(trajectory, t_s, config_.slot_s, config_.limits.acceleration_max_m_s2)};
  if (t_s + kStopsAtLatest_s >= config_.horizon_s) rest.flight.told = waypoints;
  rest.passed = std::min(trajectory.waypoint_at(t_s), rest.flight.told.size());
  return rest;
}

/// Whether a MAV that is beside its flight, since it gave way, goes on from there into something.
bool TeamFlight::leads_off(const Candidate& rest, const Flyer& flyer, const World& world, const RouteConfig& route,
                           Utime utime) const {
  constexpr double kBeside_m = 0.3;
  const double t_s = seconds(utime - rest.flight.utime);
  if ((rest.flight.trajectory.sample(t_s).p_W - flyer.now.p_W).norm() <= kBeside_m) return false;
  const Slots slots = candidate(flyer, still_ahead(rest.flight.trajectory, rest.flight.waypoints, t_s), utime).slots;
  return !obstacle_to(slots, world, route, -slots.bulge_m).empty();
}

/// Those that have something in their way that was not there before brake, be it an obstacle or fence that is new; so
/// do those that are in each other's way, because one has fallen behind: the lower priority first.
std::vector<TeamFlight::Candidate> TeamFlight::all_going_on(const World& world, const RouteConfig& route,
                                                            std::span<const Flyer> flyers, Utime utime) const {
  std::vector<Candidate> flights;
  std::vector<bool> brakes;
  for (const Flyer& flyer : flyers) {
    flights.push_back(going_on(flyer, utime));
    const Slots& slots = flights.back().slots;  // other ones than it was checked with, so by twice the bulge nearer
    const bool blocked = !obstacle_to(slots, world, route, -slots.bulge_m).empty() ||
                         (!world.is_flat() && leads_off(flights.back(), flyer, world, route, utime));
    brakes.push_back(!flyer.lost && blocked);
    if (brakes.back()) flights.back() = candidate(flyer, {}, utime);
  }
  for (bool again = true; again;) {
    again = false;
    for (std::size_t j = 0; j < flyers.size(); ++j) {
      for (std::size_t i = 0; i < j; ++i) {
        if ((brakes[i] && brakes[j]) || keep_apart(route.separation, flights[i].slots, flights[j].slots)) continue;
        const std::size_t which = brakes[j] ? i : j;
        flights[which] = candidate(flyers[which], {}, utime);
        brakes[which] = again = true;
      }
    }
  }
  return flights;
}

/// The flight along these points if the MAV goes on as before for kLate_s: it brakes later, from another speed.
Slots TeamFlight::late(const Flyer& flyer, std::span<const Eigen::Vector3d> course_W, Utime utime) const {
  Flyer then = flyer;
  const auto committed = committed_.find(flyer.mav);
  if (committed != committed_.end()) {
    const double t_s = seconds(utime - committed->second.utime);
    const Motion now = committed->second.trajectory.sample(t_s),
                 later = committed->second.trajectory.sample(t_s + kLate_s);
    then.now.p_W += later.p_W - now.p_W;
    then.now.v_W += later.v_W - now.v_W;
  }
  return slots_of(trajectory_of(then, course_W, config_.limits), 0.0, config_.slot_s,
                  config_.limits.acceleration_max_m_s2);
}

/// As much of the course as nothing is in the way of; nullopt: none of it. `status` says what is.
std::optional<TeamFlight::Candidate> TeamFlight::new_flight(const Scene& scene, const Flyer& flyer,
                                                            std::string& status) const {
  const Trajectory whole = trajectory_of(flyer, flyer.course_W, config_.limits);
  for (const double share : kTried) {
    const std::vector<Eigen::Vector3d> points_W =
        flyer.course_W.empty() ? flyer.course_W : cut(flyer, whole, share * config_.horizon_s);
    Candidate next = candidate(flyer, points_W, scene.utime);
    std::string obstacle = scene.other_mav(next.slots);
    if (obstacle.empty()) obstacle = obstacle_to(next.slots, scene.world, scene.route, next.slots.bulge_m);
    if (obstacle.empty() && !scene.world.is_flat()) {
      const Slots slots = late(flyer, points_W, scene.utime);
      obstacle = obstacle_to(slots, scene.world, scene.route, slots.bulge_m);
    }
    if (obstacle.empty()) {
      if (share == 1.0 && kStops_s < config_.horizon_s && begin_alike(whole, next.flight.trajectory)) {
        next.flight.told = stamped(flyer.course_W, whole, config_.limits.speed_max_m_s, scene.utime);
      }
      return next;
    }
    if (status.empty()) status = std::move(obstacle);
  }
  return checked_rest(scene, flyer);
}

/// Of what the MAV flies, as much as was checked, where it was told more and will soon have to stop; nullopt: it need
/// not yet, or it would turn otherwise, into something.
std::optional<TeamFlight::Candidate> TeamFlight::checked_rest(const Scene& scene, const Flyer& flyer) const {
  const Candidate& now = scene.flights[scene.me];
  const double t_s = seconds(scene.utime - now.flight.utime);
  if (now.flight.told == now.flight.waypoints || t_s + kStops_s < config_.horizon_s) return std::nullopt;
  Candidate rest = candidate(flyer, still_ahead(now.flight.trajectory, now.flight.waypoints, t_s), scene.utime);
  const bool clear = scene.other_mav(rest.slots).empty() &&
                     obstacle_to(rest.slots, scene.world, scene.route, rest.slots.bulge_m).empty();
  return clear ? std::optional(std::move(rest)) : std::nullopt;
}

std::vector<Flight> TeamFlight::plan(const World& world, const RouteConfig& route, std::span<const Flyer> flyers,
                                     Utime utime) {
  std::vector<Candidate> flights = all_going_on(world, route, flyers, utime);
  std::vector<Slots> brakes;
  for (const Flyer& flyer : flyers) brakes.push_back(candidate(flyer, {}, utime).slots);
  std::vector<Flight> result(flyers.size());
  for (std::size_t i = 0; i < flyers.size(); ++i) {
    const Scene scene{world, route, flyers, flights, brakes, i, utime};
    if (!flyers[i].lost) {
      if (auto next = new_flight(scene, flyers[i], result[i].status)) flights[i] = std::move(*next);
      const std::vector<Waypoint>& told = flights[i].flight.told;
      result[i].waypoints.assign(told.begin() + static_cast<std::ptrdiff_t>(flights[i].passed), told.end());
      std::string& status = result[i].status;
      const std::string near = scene.too_near(result[i]);
      if (!near.empty()) status = status.empty() ? near : near + "; " + status;
    }
  }
  committed_.clear();
  for (std::size_t i = 0; i < flyers.size(); ++i) committed_.insert_or_assign(flyers[i].mav, flights[i].flight);
  return result;
}

}  // namespace comptonaut
