// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <vector>

#include "core/random.h"
#include "flight/team_flight.h"

namespace comptonaut {

inline constexpr Utime kStart = 1'700'000'000 * kSecond_us;
inline constexpr double kLook_s = 0.05;  ///< between two looks at the fleet

inline RouteConfig small_field() {
  RouteConfig route;
  route.envelope = {.radius_m = 0.5, .half_height_m = 0.8};
  route.separation = {.radius_m = 2.5, .half_height_m = 3.5};
  route.fence = {.border = {{0, 0}, {40, 0}, {40, 40}, {20, 30}, {0, 40}}, .floor_m = 1.0, .ceiling_m = 10.0};
  route.step_m = 2.0;
  route.expanded_max = 200;
  return route;
}

/// How near two places are, in separations: 1 is just far enough.
inline double separations(const Envelope& separation, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d unit(separation.radius_m, separation.radius_m, separation.half_height_m);
  return (a - b).cwiseQuotient(unit).norm();
}

/// MAVs that fly exactly as they are told, late_s after they were, from tick to tick, but for those that drop out,
/// which brake at once, and for slow ones.
struct Fleet {
  struct Mav {
    Flyer flyer;
    Trajectory trajectory{Eigen::Vector3d::Zero()};
    std::vector<Waypoint> waypoints = {};
    double begin_s = 0.0;  ///< on the trajectory, now
    bool out = false;
    double pace = 1.0;  ///< at which it flies what it was told

    /// What is the rest of what it flies already changes nothing.
    void take(std::vector<Waypoint> told, const MotionLimits& limits) {
      if (out) told.clear();
      if (flyer.lost) return;
      const bool goes_on = !told.empty() && told.size() <= waypoints.size() &&
                           std::equal(told.begin(), told.end(), waypoints.end() - std::ssize(told));
      waypoints = std::move(told);
      if (goes_on) return;
      trajectory = Trajectory(flyer.now.p_W, flyer.now.v_W, waypoints, limits);
      begin_s = 0.0;
    }
  };
  const World& world;
  RouteConfig route;
  TeamFlightConfig config;
  TeamFlight team{config};
  std::vector<Mav> mavs = {};
  Utime utime = kStart;
  double late_s = 0.0;

  void add(const Eigen::Vector3d& p_W) {
    Mav mav{.flyer = {.mav = static_cast<std::int32_t>(mavs.size()) + 1, .now = {.p_W = p_W}}};
    mav.trajectory = Trajectory(p_W);
    mavs.push_back(mav);
  }

  std::vector<Flight> plan() {
    std::vector<Flyer> flyers;
    for (const Mav& mav : mavs) flyers.push_back(mav.flyer);
    return team.plan(world, route, flyers, utime);
  }

  /// Plans, then flies for dt_s; `look` sees the fleet every kLook_s.
  template <typename Look>
  std::vector<Flight> tick(double dt_s, const Look& look) {
    std::vector<Flight> flights = plan();
    fly(late_s, look);
    for (std::size_t i = 0; i < mavs.size(); ++i) mavs[i].take(flights[i].waypoints, config.limits);
    fly(dt_s - late_s, look);
    utime += microseconds(dt_s);
    return flights;
  }

  template <typename Look>
  void fly(double dt_s, const Look& look) {
    for (double t_s = 0.0; t_s <= dt_s + 1e-9; t_s += kLook_s) {
      for (Mav& mav : mavs) {
        mav.flyer.now = mav.trajectory.sample(mav.begin_s + mav.pace * t_s);
        mav.flyer.now.v_W *= mav.pace;
      }
      look(*this);
    }
    for (Mav& mav : mavs) mav.begin_s += mav.pace * dt_s;
  }

  [[nodiscard]] double nearest() const {
    double nearest = 1e9;
    for (std::size_t j = 0; j < mavs.size(); ++j) {
      for (std::size_t i = 0; i < j; ++i) {
        nearest = std::min(nearest, separations(route.separation, mavs[i].flyer.now.p_W, mavs[j].flyer.now.p_W));
      }
    }
    return nearest;
  }

  [[nodiscard]] bool touches_closed(const Mav& mav) const { return touches_closed(mav, route.envelope); }
  /// By the slow way: whether the envelope about a MAV holds any place of closed space.
  [[nodiscard]] bool touches_closed(const Mav& mav, const Envelope& envelope) const {
    const Eigen::Vector3d axes(envelope.radius_m, envelope.radius_m, envelope.half_height_m);
    const Eigen::Vector3d& p_W = mav.flyer.now.p_W;
    return world.any_closed({p_W - axes, p_W + axes}, [&](const Box& box) {
      return (p_W.cwiseMax(box.min_W).cwiseMin(box.max_W) - p_W).cwiseQuotient(axes).norm() < 1.0;
    });
  }
};

/// Where a MAV may hover: inside the fence, clear of everything, and far enough from the others.
inline bool is_free(const Fleet& fleet, const Eigen::Vector3d& p_W) {
  const RouteConfig& route = fleet.route;
  const Leg here{p_W, p_W};
  return route.fence.contains(p_W) && !fleet.world.any_closed(bounds(route.envelope, here), [&](const Box& b) {
    return sweep_meets(route.envelope, here, b);
  }) && std::ranges::all_of(fleet.mavs, [&](const Fleet::Mav& mav) {
           return separations(route.separation, mav.flyer.now.p_W, p_W) > 1.05;
         });
}

inline Eigen::Vector3d somewhere(Random& random) {
  return {random.uniform(1, 39), random.uniform(1, 39), random.uniform(2, 8)};
}

inline void add_somewhere(Fleet& fleet, Random& random, int mavs) {
  for (int tries = 0; tries < 100 && std::ssize(fleet.mavs) < mavs; ++tries) {
    const Eigen::Vector3d p_W = somewhere(random);
    if (is_free(fleet, p_W)) fleet.add(p_W);
  }
}

/// Each MAV gets somewhere to go, now and then: around obstacles, or anywhere without a thought.
inline void draw_courses(Fleet& fleet, Random& random) {
  for (Fleet::Mav& mav : fleet.mavs) {
    if (random.uniform() < 0.5) continue;
    mav.flyer.course_W.clear();
    const Eigen::Vector3d goal_W = somewhere(random);
    if (random.uniform() < 0.7) {
      mav.flyer.course_W = {goal_W, somewhere(random)};
    } else if (const auto way = find_route(fleet.world, fleet.route, mav.flyer.now.p_W, goal_W)) {
      mav.flyer.course_W.assign(way->begin() + 1, way->end());
    }
  }
}

}  // namespace comptonaut
