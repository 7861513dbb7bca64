// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/separation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace comptonaut {
namespace {

constexpr double kStep_s = 0.1;
constexpr double kNoWorse_m = 0.05;
constexpr double kMuchWorse_m = 0.3;
constexpr double kStanding_m_s = 0.1;

/// Where a MAV is `t_s` after it began to brake.
Eigen::Vector3d braking(const Motion& motion, double t_s, double acceleration) {
  const double speed = motion.v_W.norm();
  const double t = std::min(t_s, speed / acceleration);
  return speed > 0.0 ? Eigen::Vector3d(motion.p_W + t * (1.0 - 0.5 * acceleration * t / speed) * motion.v_W)
                     : motion.p_W;
}

struct Forecast {
  double now_m = 0.0;
  double go_end_m = 0.0;                                    ///< at the end of going on
  double go_m = std::numeric_limits<double>::infinity();    ///< smallest distance when going on
  double stop_m = std::numeric_limits<double>::infinity();  ///< and when braking at once
};

Forecast forecast(const Intent& intent, const StampedPose& other, bool other_goes_on, const SeparationConfig& config,
                  double acceleration) {
  const Motion now = intent.trajectory.sample(intent.t_s);
  const Motion later = intent.trajectory.sample(intent.t_s + config.reaction_s);
  const Eigen::Vector3d v_other_W = other.q_WB * other.v_WB_B;
  const double age_s = std::max(0.0, seconds(intent.utime - other.utime));
  const Motion other_now{.p_W = other.p_WB + age_s * v_other_W, .v_W = v_other_W, .a_W = {}};
  const Motion other_later{.p_W = other_now.p_W + config.reaction_s * v_other_W, .v_W = v_other_W, .a_W = {}};
  const double speed = std::max({now.v_W.norm(), later.v_W.norm(), v_other_W.norm()});

  const auto distance_m = [&](const Eigen::Vector3d& p_W, const Eigen::Vector3d& p_other_W) {
    return (p_W - p_other_W).cwiseProduct(Eigen::Vector3d(1, 1, config.height_weight)).norm();
  };
  Forecast result{.now_m = distance_m(now.p_W, other_now.p_W)};
  for (double t = kStep_s; t < config.reaction_s + speed / acceleration + kStep_s; t += kStep_s) {
    const double braking_s = t - config.reaction_s;
    const bool straight_on = other_goes_on || braking_s < 0.0;
    const Eigen::Vector3d p_other_W =
        straight_on ? Eigen::Vector3d(other_now.p_W + t * v_other_W) : braking(other_later, braking_s, acceleration);
    const Eigen::Vector3d p_go_W =
        braking_s < 0.0 ? intent.trajectory.sample(intent.t_s + t).p_W : braking(later, braking_s, acceleration);
    result.go_end_m = distance_m(p_go_W, p_other_W);
    result.go_m = std::min(result.go_m, result.go_end_m);
    result.stop_m = std::min(result.stop_m, distance_m(braking(now, t, acceleration), p_other_W));
  }
  // What stands, or steps aside, must not get nearer; what flies had better stop unless that is worse; what brakes goes
  // on braking unless that is much worse, or it would change its mind at every step.
  const bool out_of_the_way = intent.aside || now.v_W.norm() < kStanding_m_s;
  result.stop_m += out_of_the_way ? -kNoWorse_m : intent.giving_way ? kMuchWorse_m : kNoWorse_m;
  return result;
}

}  // namespace

std::optional<int> must_stop_for(const Intent& intent, const Others& others, const SeparationConfig& config,
                                 double acceleration_max_m_s2) {
  const double speed_m_s = intent.trajectory.sample(intent.t_s).v_W.norm();
  for (const auto& [mav, pose] : others) {
    if (mav == intent.mav || std::abs(seconds(intent.utime - pose.utime)) > config.pose_age_max_s) continue;
    const bool has_priority = mav < intent.mav;
    const double limit_m = config.distance_min_m + (has_priority ? config.give_way_extra_m : 0.0) +
                           (intent.giving_way ? config.release_extra_m : 0.0) +
                           config.speed_margin_s * (speed_m_s + pose.v_WB_B.norm());
    const Forecast distance = forecast(intent, pose, has_priority, config, acceleration_max_m_s2);
    // Two that are too near already do not stand there for ever: one that gets away goes on.
    const bool leaves = distance.go_m > distance.now_m - kNoWorse_m && distance.go_end_m > distance.now_m;
    if (distance.go_m < limit_m && distance.go_m < distance.stop_m && !leaves) return mav;
  }
  return std::nullopt;
}

}  // namespace comptonaut
