// SPDX-License-Identifier: BSD-3-Clause
#include "flight/profile.h"

#include <algorithm>
#include <cmath>

namespace comptonaut {
namespace {

constexpr double kSame_m = 1e-9;

double square(double x) { return x * x; }

/// The blend at constant acceleration leaves the corner by v^2 |e2 - e1|^2 / (8 a), and takes at most half of each leg.
double corner_speed_max(const StraightLeg& before, const StraightLeg& after, const MotionLimits& limits) {
  const double turn = (after.direction - before.direction).norm();
  const double a = limits.acceleration_max_m_s2;
  double v2 = square(std::min(before.speed_max_m_s, after.speed_max_m_s));
  if (turn > 1e-12) {
    v2 = std::min({v2, 8.0 * a * limits.corner_deviation_max_m / square(turn),
                   a * std::min(before.length_m, after.length_m) / turn});
  }
  return std::sqrt(v2);
}

std::vector<StraightLeg> straight_legs(Eigen::Vector3d from_W, std::span<const Waypoint> waypoints,
                                       const MotionLimits& limits) {
  std::vector<StraightLeg> legs;
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    const Waypoint& to = waypoints[i];
    const double length_m = (to.p_W - from_W).norm();
    if (length_m < kSame_m) continue;
    const double speed = to.speed_max_m_s > 0.0 ? to.speed_max_m_s : limits.speed_max_m_s;
    legs.push_back({from_W, (to.p_W - from_W) / length_m, length_m, std::min(speed, limits.speed_max_m_s), i});
    from_W = to.p_W;
  }
  return legs;
}

/// What is left of a leg between the blends at its ends.
double straight_m(const Profile& profile, std::size_t leg, double acceleration_m_s2) {
  const double blends_m = blend_m(profile, leg, acceleration_m_s2) + blend_m(profile, leg + 1, acceleration_m_s2);
  return std::max(0.0, profile.legs[leg].length_m - blends_m);
}

/// Lowers corner speeds until each can be reached from its neighbours. False: the first one is too fast to begin with.
bool make_reachable(Profile& profile, double acceleration_m_s2) {
  std::vector<double>& v = profile.speeds_m_s;
  const auto reachable = [&](std::size_t leg, double from) {
    return std::sqrt(square(from) + 2.0 * acceleration_m_s2 * straight_m(profile, leg, acceleration_m_s2));
  };
  for (std::size_t i = v.size() - 1; i-- > 1;) v[i] = std::min(v[i], reachable(i, v[i + 1]));
  if (v.size() > 1 && v[0] > reachable(0, v[1])) return false;
  for (std::size_t i = 1; i < v.size(); ++i) v[i] = std::min(v[i], reachable(i - 1, v[i - 1]));
  return true;
}

/// The start manoeuvre to `speed` towards the first waypoint: its end's direction depends on where it ends, and that
/// on the direction, so both are found by iteration. nullopt: no such manoeuvre.
std::optional<Profile> start_manoeuvre(const Motion& now, const Eigen::Vector3d& to_W, double speed_m_s,
                                       double acceleration_m_s2) {
  constexpr double kConverged = 1e-10;
  Profile profile{.start = now, .start_s = 0.0, .legs = {}, .speeds_m_s = {speed_m_s}};
  Eigen::Vector3d direction = (to_W - now.p_W).normalized();
  for (int iteration = 0; iteration < 100; ++iteration) {
    const Eigen::Vector3d change = speed_m_s * direction - now.v_W;
    profile.start_s = change.norm() / acceleration_m_s2;
    profile.start.a_W = profile.start_s > 0.0 ? Eigen::Vector3d(change / profile.start_s) : Eigen::Vector3d::Zero();
    const Eigen::Vector3d end_W = now.p_W + profile.start_s * (now.v_W + 0.5 * change);
    const Eigen::Vector3d next = (to_W - end_W).normalized();
    if (speed_m_s == 0.0 || (next - direction).norm() < kConverged) return profile;
    direction = next;
  }
  return std::nullopt;
}

}  // namespace

Motion after(const Motion& motion, double dt_s) {
  return {.p_W = motion.p_W + dt_s * motion.v_W + 0.5 * dt_s * dt_s * motion.a_W,
          .v_W = motion.v_W + dt_s * motion.a_W,
          .a_W = motion.a_W};
}

double blend_m(const Profile& profile, std::size_t corner, double acceleration_m_s2) {
  if (corner == 0 || corner == profile.legs.size()) return 0.0;
  const Eigen::Vector3d turn = profile.legs[corner].direction - profile.legs[corner - 1].direction;
  return square(profile.speeds_m_s[corner]) * turn.norm() / (2.0 * acceleration_m_s2);
}

std::optional<Profile> profile_from(const Motion& now, std::span<const Waypoint> waypoints, const MotionLimits& limits,
                                    double start_speed_m_s) {
  const double a = limits.acceleration_max_m_s2;
  const Eigen::Vector3d& first_W = waypoints.empty() ? now.p_W : waypoints.front().p_W;
  auto profile = start_manoeuvre(now, first_W, start_speed_m_s, a);
  if (!profile) return std::nullopt;
  profile->legs = straight_legs(after(profile->start, profile->start_s).p_W, waypoints, limits);
  if (profile->legs.empty()) return start_speed_m_s == 0.0 ? profile : std::nullopt;
  const bool on_first_leg = profile->legs[0].waypoint == 0 && start_speed_m_s <= profile->legs[0].speed_max_m_s;
  if (start_speed_m_s > 0.0 && !on_first_leg) return std::nullopt;
  for (std::size_t i = 1; i < profile->legs.size(); ++i) {
    profile->speeds_m_s.push_back(corner_speed_max(profile->legs[i - 1], profile->legs[i], limits));
  }
  profile->speeds_m_s.push_back(0.0);
  if (!make_reachable(*profile, a)) return std::nullopt;
  return profile;
}

}  // namespace comptonaut
