// SPDX-License-Identifier: BSD-3-Clause
#include "flight/trajectory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "flight/profile.h"

namespace comptonaut {
namespace {

/// Start speeds that are tried, as shares of the present speed; the quickest flight is taken.
constexpr int kStartSpeeds = 8;

void check(const Motion& now, std::span<const Waypoint> waypoints, const MotionLimits& limits) {
  bool finite = now.p_W.allFinite() && now.v_W.allFinite();
  for (const Waypoint& waypoint : waypoints) {
    finite = finite && waypoint.p_W.allFinite() && std::isfinite(waypoint.speed_max_m_s);
  }
  if (!finite) throw std::invalid_argument("a trajectory's start or waypoint is not finite");
  for (const double limit : {limits.speed_max_m_s, limits.acceleration_max_m_s2, limits.corner_deviation_max_m}) {
    if (!(limit > 0.0) || !std::isfinite(limit)) {
      throw std::invalid_argument(fmt::format("a trajectory's limit is {}, must be positive", limit));
    }
  }
}

}  // namespace

Trajectory::Trajectory(const Eigen::Vector3d& p_W) { rest_at(p_W, 0); }

Trajectory::Trajectory(const Eigen::Vector3d& p_W, const Eigen::Vector3d& v_W, std::span<const Waypoint> waypoints,
                       const MotionLimits& limits) {
  const Motion now{.p_W = p_W, .v_W = v_W, .a_W = Eigen::Vector3d::Zero()};
  check(now, waypoints, limits);
  const double a = limits.acceleration_max_m_s2;
  fly(*profile_from(now, waypoints, limits, 0.0), a, waypoints.size());
  const double speed_m_s = std::min(v_W.norm(), limits.speed_max_m_s);
  for (int k = 1; k <= kStartSpeeds && speed_m_s > 0.0; ++k) {
    const auto profile = profile_from(now, waypoints, limits, speed_m_s * k / kStartSpeeds);
    if (!profile) continue;
    Trajectory other(p_W);
    other.fly(*profile, a, waypoints.size());
    if (other.duration_s_ < duration_s_) *this = other;
  }
}

void Trajectory::fly(const Profile& profile, double acceleration_m_s2, std::size_t waypoints) {
  pieces_.clear();
  duration_s_ = 0.0;
  const std::vector<StraightLeg>& legs = profile.legs;
  append(profile.start_s, profile.start, legs.empty() ? waypoints : legs[0].waypoint);
  for (std::size_t i = 0; i < legs.size(); ++i) {
    const double blend_end_m = blend_m(profile, i, acceleration_m_s2);
    const double blend_start_m = legs[i].length_m - blend_m(profile, i + 1, acceleration_m_s2);
    fly_straight(legs[i], blend_end_m, blend_start_m, profile.speeds_m_s[i], profile.speeds_m_s[i + 1],
                 acceleration_m_s2);
    if (i + 1 < legs.size())
      fly_corner(legs[i], legs[i + 1], blend_start_m, profile.speeds_m_s[i + 1], acceleration_m_s2);
  }
  const Motion end = after(profile.start, profile.start_s);
  rest_at(legs.empty() ? end.p_W : legs.back().from_W + legs.back().length_m * legs.back().direction, waypoints);
}

// Trapezoid of speed from distance `from_m` to `to_m` of the leg.
void Trajectory::fly_straight(const StraightLeg& leg, double from_m, double to_m, double v0, double v1, double a) {
  const double length_m = std::max(0.0, to_m - from_m);
  const double peak = std::min(leg.speed_max_m_s, std::sqrt(a * length_m + 0.5 * (v0 * v0 + v1 * v1)));
  const double speed_up_m = std::max(0.0, (peak * peak - v0 * v0) / (2.0 * a));
  const double slow_down_m = std::max(0.0, (peak * peak - v1 * v1) / (2.0 * a));
  const double cruise_m = std::max(0.0, length_m - speed_up_m - slow_down_m);
  const auto piece = [&](double duration_s, double at_m, double speed, double acceleration) {
    append(
        duration_s,
        {.p_W = leg.from_W + at_m * leg.direction, .v_W = speed * leg.direction, .a_W = acceleration * leg.direction},
        leg.waypoint);
  };
  piece((peak - v0) / a, from_m, v0, a);
  if (cruise_m > 0.0) piece(cruise_m / peak, from_m + speed_up_m, peak, 0.0);
  piece((peak - v1) / a, to_m - slow_down_m, peak, -a);
}

// In two halves: in the second one the next waypoint is flown to.
void Trajectory::fly_corner(const StraightLeg& before, const StraightLeg& next, double from_m, double speed_m_s,
                            double acceleration_m_s2) {
  const Eigen::Vector3d change = speed_m_s * (next.direction - before.direction);
  const double duration_s = change.norm() / acceleration_m_s2;
  if (!(duration_s > 0.0)) return;
  const Motion start{.p_W = before.from_W + from_m * before.direction,
                     .v_W = speed_m_s * before.direction,
                     .a_W = change / duration_s};
  append(0.5 * duration_s, start, before.waypoint);
  append(0.5 * duration_s, after(start, 0.5 * duration_s), next.waypoint);
}

void Trajectory::append(double duration_s, const Motion& motion, std::size_t waypoint) {
  if (!(duration_s > 0.0)) return;
  pieces_.push_back({.start_s = duration_s_, .motion = motion, .waypoint = waypoint});
  duration_s_ += duration_s;
}

void Trajectory::rest_at(const Eigen::Vector3d& p_W, std::size_t waypoint) {
  const Motion rest{.p_W = p_W, .v_W = Eigen::Vector3d::Zero(), .a_W = Eigen::Vector3d::Zero()};
  pieces_.push_back({.start_s = duration_s_, .motion = rest, .waypoint = waypoint});
}

const Trajectory::Piece& Trajectory::piece_at(double t_s) const {
  const auto next = std::ranges::upper_bound(pieces_, t_s, {}, &Piece::start_s);
  return next == pieces_.begin() ? *next : *(next - 1);
}

Motion Trajectory::sample(double t_s) const {
  const Piece& piece = piece_at(t_s);
  return after(piece.motion, std::max(0.0, t_s - piece.start_s));
}

std::size_t Trajectory::waypoint_at(double t_s) const { return piece_at(t_s).waypoint; }

double Trajectory::arrival_s(std::size_t waypoint) const {
  const auto later = std::ranges::find_if(pieces_, [&](const Piece& piece) { return piece.waypoint > waypoint; });
  return later == pieces_.end() ? duration_s_ : later->start_s;
}

}  // namespace comptonaut
