// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "nodes/pilot.h"
#include "start_time.h"

namespace comptonaut {

inline constexpr Utime kTick_us = 20'000;

/// A pilot whose vehicle is always where it is told to be.
struct PerfectVehicle {
  Pilot pilot;
  StampedPose pose;

  PerfectVehicle(const PilotConfig& config, const Eigen::Vector3d& p_WB) : pilot(config) {
    pose.utime = kStart_us;
    pose.p_WB = p_WB;
  }
  /// Monotonic time runs with the time of the poses.
  [[nodiscard]] double now_s() const { return seconds(pose.utime - kStart_us); }
  void step(const Others& others = {}) {
    pose.utime += kTick_us;
    const Motion motion = pilot.steer(pose, others, now_s());
    pose.p_WB = motion.p_W;
    pose.v_WB_B = motion.v_W;
  }
  void step_until(double t_s) {
    while (now_s() < t_s) step();
  }
};

inline Plan plan_for(int mav, std::int64_t number, const std::vector<Eigen::Vector3d>& points, double speed = 8.0) {
  Plan plan{.mav = mav, .term = 1, .number = number};
  for (const Eigen::Vector3d& p_W : points) plan.waypoints.push_back({.p_W = p_W, .speed_max_m_s = speed});
  return plan;
}

inline std::int64_t count(const std::vector<Counter>& counters, const std::string& name) {
  for (const Counter& counter : counters) {
    if (counter.name == name) return counter.value;
  }
  return -1;
}

}  // namespace comptonaut
