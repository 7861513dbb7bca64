// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "nodes/truth.h"
#include "sim/autopilot.h"
#include "sim/scenario.h"
#include "sim/sim_camera.h"
#include "sim/sim_detector.h"

namespace comptonaut {

/// The simulated truth: sources, cameras, vehicles. Stands behind the same two wires as the hardware, a t3pa stream and
/// MAVLink for each MAV. Seeded by (seed, purpose, MAV): what one MAV measures depends on where it is, not on the
/// others or on who asks first.
class SimWorld {
 public:
  /// Time goes on in steps of this length.
  static constexpr Utime kStep_us = 10'000;

  /// `camera` must outlive this. Throws std::runtime_error where the scenario's sources find no room.
  SimWorld(const SimCamera& camera, const Scenario& scenario, std::uint64_t seed, Utime start_utime);

  /// The t3pa stream's beginning for MAV 1, 2, ...
  [[nodiscard]] std::string stream_start(int mav);
  /// What MAV's autopilot sends now, before the step.
  [[nodiscard]] std::vector<SimAutopilot::Frame> mavlink(int mav);
  void on_mavlink(int mav, std::span<const std::uint8_t> bytes);
  /// One step on; the t3pa text that each camera sends within it, MAV 1 first.
  [[nodiscard]] std::vector<std::string> step();

  /// The scan that MAV's range sensor makes after this step; nullopt: it has none, or makes none now.
  [[nodiscard]] std::optional<RangePoints> range_points(int mav);

  [[nodiscard]] int mavs() const { return static_cast<int>(mavs_.size()); }
  [[nodiscard]] Utime utime() const { return utime_; }
  [[nodiscard]] Utime start_utime() const { return start_utime_; }
  [[nodiscard]] const std::vector<TrueSource>& sources() const { return sources_; }
  [[nodiscard]] Truth truth() const;
  [[nodiscard]] const Eigen::Vector3d& p_WB(int mav) const { return mavs_[mav - 1].autopilot.vehicle().p_WB(); }
  /// Between any two MAVs so far, m; infinite for one MAV.
  [[nodiscard]] double distance_min_m() const { return distance_min_m_; }
  /// How often a MAV, 0.6 m wide, came into an obstacle or into unknown space; 0 on flat ground.
  [[nodiscard]] int collisions() const { return collisions_; }

 private:
  struct Mav {
    SimAutopilot autopilot;
    SimDetector detector;
    std::optional<RangeSensor> range_sensor;
    bool touches = false;  ///< an obstacle
  };

  void note_distances();
  void note_collisions();

  Scenario scenario_;
  Utime start_utime_;
  Utime utime_;
  std::vector<TrueSource> sources_;
  std::vector<Mav> mavs_;
  double distance_min_m_ = std::numeric_limits<double>::infinity();
  int collisions_ = 0;
};

}  // namespace comptonaut
