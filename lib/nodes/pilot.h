// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/pose.h"
#include "flight/plan.h"
#include "flight/trajectory.h"
#include "nodes/separation.h"
#include "nodes/status.h"

namespace comptonaut {

struct PilotConfig {
  int mav = 1;
  MotionLimits limits;
  /// Where to return to; NaN: to where the first pose was.
  Eigen::Vector3d p_WHome_m = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  double plan_timeout_s = 3.0;     ///< without a plan: hold
  double return_timeout_s = 15.0;  ///< without a plan: fly home
  double return_speed_m_s = 2.0;
  double return_z_m = 0.0;            ///< in W: a MAV that is lower climbs to it before it flies home
  double tracking_error_max_m = 2.0;  ///< beyond it a new way starts from where the vehicle is, not where it should be
  SeparationConfig separation;
};

/// Decides where a MAV should be at each moment: along its plan, holding, giving way, or on its way home.
class Pilot {
 public:
  explicit Pilot(const PilotConfig& config) : config_(config) {}

  /// Only a newer plan for this MAV is flown: greater (term, number). Once none has come for plan_timeout_s any number
  /// of the same term will do: numbers are of the team's time, and a leader that started anew may have a better one.
  /// One whose waypoints are the rest of the flown one changes nothing; one that goes on as before and then differs
  /// bends the flight without a stop.
  void take_plan(const Plan& plan, double monotonic_s);

  /// Where to be now, given where it is and where the others are.
  [[nodiscard]] Motion steer(const StampedPose& pose, const Others& others, double monotonic_s);

  [[nodiscard]] std::int64_t plan_number() const { return plan_ ? plan_->second : -1; }
  /// Index of the plan's waypoint that is flown to.
  [[nodiscard]] std::int32_t waypoint() const;
  [[nodiscard]] std::string hold_reason() const;
  /// NaN before the first pose where none is configured.
  [[nodiscard]] const Eigen::Vector3d& p_WHome() const { return config_.p_WHome_m; }
  [[nodiscard]] std::vector<Counter> counters() const;

 private:
  enum class Stage { kNoPlan, kPlan, kPlanIsOld, kReturn };
  struct GivingWay {
    int mav;
    Utime since;
  };

  void watch_plan_age(double monotonic_s);
  void set_way(std::vector<Waypoint> way, std::size_t next);
  void fly(std::span<const Waypoint> waypoints);
  [[nodiscard]] bool goes_on_with(const std::vector<Waypoint>& waypoints);
  void keep_separation(const Others& others);
  void step_aside(const Others& others);
  [[nodiscard]] Motion present() const;
  [[nodiscard]] double t_s() const { return seconds(pose_->utime - start_utime_); }
  [[nodiscard]] std::size_t target() const;

  PilotConfig config_;
  std::optional<StampedPose> pose_;
  std::optional<std::pair<std::int64_t, std::int64_t>> plan_;  ///< term and number
  double plan_s_ = 0.0;                                        ///< monotonic time of the last plan
  Stage stage_ = Stage::kNoPlan;
  std::vector<Waypoint> way_;
  std::size_t next_ = 0;        ///< index in way_ of the trajectory's first waypoint
  std::size_t plan_begin_ = 0;  ///< index in way_ of the newest plan's first waypoint
  Trajectory trajectory_{Eigen::Vector3d::Zero()};
  Utime start_utime_ = 0;  ///< of the trajectory
  std::optional<GivingWay> giving_way_;
  std::int64_t plans_taken_ = 0, plans_continued_ = 0, plans_stale_ = 0, plans_refused_ = 0;
  std::int64_t plan_timeouts_ = 0, returns_ = 0, gave_way_ = 0, stepped_aside_ = 0;
};

}  // namespace comptonaut
