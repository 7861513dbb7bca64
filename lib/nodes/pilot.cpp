// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/pilot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace comptonaut {
namespace {

bool is_sound(const Plan& plan) {
  return std::ranges::all_of(plan.waypoints, [](const Waypoint& waypoint) {
    return waypoint.p_W.allFinite() && std::isfinite(waypoint.speed_max_m_s);
  });
}

bool same(std::span<const Waypoint> a, std::span<const Waypoint> b) {
  constexpr double kSame = 1e-6;
  return std::ranges::equal(a, b, [](const Waypoint& x, const Waypoint& y) {
    return (x.p_W - y.p_W).norm() < kSame && std::abs(x.speed_max_m_s - y.speed_max_m_s) < kSame;
  });
}

}  // namespace

void Pilot::take_plan(const Plan& plan, double monotonic_s) {
  const std::pair key(plan.term, plan.number);
  if (plan.mav != config_.mav || !is_sound(plan)) {
    ++plans_refused_;
    return;
  }
  const bool timed_out = stage_ == Stage::kPlanIsOld || stage_ == Stage::kReturn;
  if (plan_ && key < *plan_ && (!timed_out || key.first < plan_->first)) {
    ++plans_stale_;
    return;
  }
  plan_s_ = monotonic_s;
  if (plan_ == key && stage_ == Stage::kPlan) return;
  plan_ = key;
  ++plans_taken_;
  const bool flying = std::exchange(stage_, Stage::kPlan) == Stage::kPlan && pose_;
  if (!flying) return set_way(plan.waypoints, 0);
  if (goes_on_with(plan.waypoints)) ++plans_continued_;
}

// True where the trajectory goes on as it is.
bool Pilot::goes_on_with(const std::vector<Waypoint>& waypoints) {
  const std::span<const Waypoint> way(way_), fresh(waypoints);
  const std::size_t to = target();
  // The new plan may begin with waypoints that have been passed since its poses were measured.
  for (std::size_t passed = 0; to < way.size() && passed <= to && passed < fresh.size(); ++passed) {
    if (!same(fresh.first(passed + 1), way.subspan(to - passed, passed + 1))) continue;
    const bool goes_on = same(fresh.subspan(passed), way.subspan(to));
    if (goes_on) {
      plan_begin_ = to - passed;
    } else {
      set_way(waypoints, passed);
    }
    return goes_on;
  }
  // Or lack the one that is just being reached.
  const bool reaching = to < way.size() && (present().p_W - way[to].p_W).norm() < config_.tracking_error_max_m;
  if (reaching && !fresh.empty() && same(fresh, way.subspan(to + 1))) {
    plan_begin_ = to + 1;
    return true;
  }
  set_way(waypoints, 0);
  return false;
}

void Pilot::set_way(std::vector<Waypoint> way, std::size_t next) {
  way_ = std::move(way);
  next_ = next;
  plan_begin_ = 0;
  if (pose_ && !giving_way_) fly(std::span(way_).subspan(next_));
}

void Pilot::fly(std::span<const Waypoint> waypoints) {
  const Motion now = present();
  trajectory_ = Trajectory(now.p_W, now.v_W, waypoints, config_.limits);
  start_utime_ = pose_->utime;
}

Motion Pilot::present() const {
  const Motion wanted = trajectory_.sample(t_s());
  if ((wanted.p_W - pose_->p_WB).norm() <= config_.tracking_error_max_m) return wanted;
  return {.p_W = pose_->p_WB, .v_W = pose_->q_WB * pose_->v_WB_B, .a_W = Eigen::Vector3d::Zero()};
}

std::size_t Pilot::target() const { return giving_way_ || !pose_ ? next_ : next_ + trajectory_.waypoint_at(t_s()); }

Motion Pilot::steer(const StampedPose& pose, const Others& others, double monotonic_s) {
  const bool first = !pose_;
  const bool clock_reset = pose_ && pose.utime < pose_->utime;
  pose_ = pose;
  if (first || clock_reset) {
    if (!config_.p_WHome_m.allFinite()) config_.p_WHome_m = pose.p_WB;
    trajectory_ = Trajectory(pose.p_WB);
    start_utime_ = pose.utime;
    giving_way_.reset();
    fly(std::span(way_).subspan(next_));
  }
  watch_plan_age(monotonic_s);
  keep_separation(others);
  return trajectory_.sample(t_s());
}

void Pilot::watch_plan_age(double monotonic_s) {
  if (stage_ == Stage::kNoPlan) return;
  const double age_s = monotonic_s - plan_s_;
  if (stage_ == Stage::kPlan && age_s > config_.plan_timeout_s) {
    stage_ = Stage::kPlanIsOld;
    ++plan_timeouts_;
    set_way({}, 0);
  }
  if (stage_ == Stage::kPlanIsOld && age_s > config_.return_timeout_s) {
    stage_ = Stage::kReturn;
    ++returns_;
    const Eigen::Vector3d& p_W = pose_->p_WB;
    const double z_m = std::max(p_W.z(), config_.return_z_m);
    const Eigen::Vector3d climbed(p_W.x(), p_W.y(), z_m), above_home(p_WHome().x(), p_WHome().y(), z_m);
    set_way({{.p_W = climbed, .speed_max_m_s = config_.return_speed_m_s},
             {.p_W = above_home, .speed_max_m_s = config_.return_speed_m_s}},
            0);
  }
}

void Pilot::keep_separation(const Others& others) {
  const double a = config_.limits.acceleration_max_m_s2;
  const auto stop_for = [&](const Trajectory& trajectory, double t, bool aside = false) {
    return must_stop_for({config_.mav, pose_->utime, trajectory, t, giving_way_.has_value(), aside}, others,
                         config_.separation, a);
  };
  if (!giving_way_) {
    const auto other = stop_for(trajectory_, t_s());
    if (!other) return;
    next_ = target();
    giving_way_ = GivingWay{.mav = *other, .since = pose_->utime};
    ++gave_way_;
    return fly({});
  }
  const Motion now = present();
  const Trajectory onward(now.p_W, now.v_W, std::span(way_).subspan(next_), config_.limits);
  if (const auto other = stop_for(onward, 0.0)) {
    giving_way_->mav = *other;
    if (stop_for(trajectory_, t_s(), true)) fly({});  // it was stepping aside, into somebody else's way
    return step_aside(others);
  }
  giving_way_.reset();
  trajectory_ = onward;
  start_utime_ = pose_->utime;
}

// The higher number moves out of the way, so that two that block each other do not stand for ever.
void Pilot::step_aside(const Others& others) {
  const SeparationConfig& separation = config_.separation;
  const bool due = separation.step_aside_after_s > 0.0 && giving_way_->mav < config_.mav &&
                   seconds(pose_->utime - giving_way_->since) > separation.step_aside_after_s;
  if (!due || trajectory_.sample(t_s()).v_W.norm() > 0.0) return;
  giving_way_->since = pose_->utime;
  const Motion now = present();
  Eigen::Vector3d away = now.p_W - others.at(giving_way_->mav).p_WB;
  away.z() = 0.0;
  if (!(away.norm() > 0.0)) away = Eigen::Vector3d::UnitX();
  away.normalize();
  const double step_m = separation.distance_min_m + separation.give_way_extra_m + separation.release_extra_m;
  const Eigen::Vector3d left(-away.y(), away.x(), 0.0);
  for (const Eigen::Vector3d& direction : {left, Eigen::Vector3d(-left), away}) {
    const std::vector<Waypoint> aside{{.p_W = now.p_W + step_m * direction, .speed_max_m_s = config_.return_speed_m_s}};
    const Trajectory step(now.p_W, now.v_W, aside, config_.limits);
    const Intent intent{config_.mav, pose_->utime, step, 0.0, true, true};
    if (must_stop_for(intent, others, separation, config_.limits.acceleration_max_m_s2)) continue;
    ++stepped_aside_;
    return fly(aside);
  }
}

std::int32_t Pilot::waypoint() const {
  const std::size_t to = target();
  return stage_ == Stage::kPlan && to > plan_begin_ ? static_cast<std::int32_t>(to - plan_begin_) : 0;
}

std::string Pilot::hold_reason() const {
  if (giving_way_) return fmt::format("giving way to MAV {}", giving_way_->mav);
  switch (stage_) {
    case Stage::kNoPlan:
      return "no plan yet";
    case Stage::kPlanIsOld:
      return fmt::format("no plan for {} s", config_.plan_timeout_s);
    case Stage::kReturn:
      return fmt::format("no plan for {} s: returning home", config_.return_timeout_s);
    case Stage::kPlan:
      return way_.empty() ? "the plan says hold" : "";
  }
  return "";
}

std::vector<Counter> Pilot::counters() const {
  return {{"plans_taken", plans_taken_},     {"plans_continued", plans_continued_}, {"plans_stale", plans_stale_},
          {"plans_refused", plans_refused_}, {"plan_timeouts", plan_timeouts_},     {"returns", returns_},
          {"gave_way", gave_way_},           {"stepped_aside", stepped_aside_}};
}

}  // namespace comptonaut
