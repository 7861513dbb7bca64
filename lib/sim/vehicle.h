// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/pose.h"

namespace comptonaut {

struct VehicleLimits {
  double speed_max_m_s = 8.0;
  double acceleration_max_m_s2 = 4.0;
};

/// Where an autopilot is told to be: a point that moves, frame W.
struct Setpoint {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  ///< m
  Eigen::Vector3d v_W = Eigen::Vector3d::Zero();  ///< m/s
  Eigen::Vector3d a_W = Eigen::Vector3d::Zero();  ///< m/s^2
  std::optional<double> yaw_rad = std::nullopt;   ///< nullopt: keep the yaw
};

/// A multirotor with its autopilot's position loop: a point mass whose acceleration follows its command within about
/// 0.1 s and tilts the body, as thrust does. Without setpoints for 0.5 s it brakes and holds. Its speed and its
/// acceleration never exceed the limits, whatever the setpoints are.
class SimVehicle {
 public:
  /// At rest at p_WB, yaw 0.
  SimVehicle(const VehicleLimits& limits, const Eigen::Vector3d& p_WB);

  void command(const Setpoint& setpoint, double t_s);
  /// Moves on from t_s to t_s + dt_s (some 10 ms).
  void step(double t_s, double dt_s);

  /// The true state; utime is left 0.
  [[nodiscard]] StampedPose pose() const;
  [[nodiscard]] const Eigen::Vector3d& p_WB() const { return p_WB_; }
  [[nodiscard]] const Eigen::Vector3d& v_WB() const { return v_WB_; }

 private:
  [[nodiscard]] Eigen::Vector3d wanted_acceleration(double t_s);
  void turn(double dt_s);

  VehicleLimits limits_;
  Setpoint setpoint_;
  double setpoint_t_s_;
  bool holding_ = true;
  Eigen::Vector3d p_WB_;
  Eigen::Vector3d v_WB_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d a_WB_ = Eigen::Vector3d::Zero();
  double yaw_rad_ = 0.0;
  Eigen::Quaterniond q_WB_ = Eigen::Quaterniond::Identity();
  Eigen::Vector3d w_WB_B_ = Eigen::Vector3d::Zero();
};

}  // namespace comptonaut
