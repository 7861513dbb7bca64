// SPDX-License-Identifier: BSD-3-Clause
#include "sim/vehicle.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace comptonaut {
namespace {

constexpr double kPositionGain_1_s = 1.5;
constexpr double kVelocityGain_1_s = 4.0;
constexpr double kThrustLag_s = 0.1;
constexpr double kSetpointTimeout_s = 0.5;
constexpr double kYawRateMax_rad_s = 1.0;
constexpr double kGravity_m_s2 = 9.81;

Eigen::Vector3d limited(const Eigen::Vector3d& x, double norm_max) {
  const double norm = x.norm();
  return norm > norm_max ? Eigen::Vector3d(x * (norm_max / norm)) : x;
}

/// The attitude that a multirotor needs for this acceleration: thrust along a + g, nose towards the yaw.
Eigen::Quaterniond attitude(const Eigen::Vector3d& a_W, double yaw_rad) {
  const Eigen::Vector3d up_W = (a_W + kGravity_m_s2 * Eigen::Vector3d::UnitZ()).normalized();
  // The shortest turn from z to up. Eigen's FromTwoVectors also knows opposite vectors, for 10 s of compiling.
  const Eigen::Quaterniond tilt(1.0 + up_W.z(), -up_W.y(), up_W.x(), 0.0);
  return tilt.normalized() * from_yaw(yaw_rad);
}

}  // namespace

SimVehicle::SimVehicle(const VehicleLimits& limits, const Eigen::Vector3d& p_WB)
    : limits_(limits), setpoint_{.p_W = p_WB}, setpoint_t_s_(0.0), p_WB_(p_WB) {}

void SimVehicle::command(const Setpoint& setpoint, double t_s) {
  setpoint_ = setpoint;
  setpoint_t_s_ = t_s;
  holding_ = false;
}

Eigen::Vector3d SimVehicle::wanted_acceleration(double t_s) {
  const double age_s = t_s - setpoint_t_s_;
  if (!holding_ && age_s > kSetpointTimeout_s) {
    holding_ = true;
    const double braking_m = v_WB_.squaredNorm() / (2.0 * limits_.acceleration_max_m_s2);
    setpoint_ = {.p_W = p_WB_ + braking_m * v_WB_.normalized()};
  }
  const double ahead_s = holding_ ? 0.0 : age_s;
  const Eigen::Vector3d v_ahead_W = setpoint_.v_W + ahead_s * setpoint_.a_W;
  const Eigen::Vector3d p_ahead_W = setpoint_.p_W + 0.5 * ahead_s * (setpoint_.v_W + v_ahead_W);
  const Eigen::Vector3d v_wanted_W = v_ahead_W + kPositionGain_1_s * (p_ahead_W - p_WB_);
  const Eigen::Vector3d v_error_W = limited(v_wanted_W, limits_.speed_max_m_s) - v_WB_;
  return limited(setpoint_.a_W + kVelocityGain_1_s * v_error_W, limits_.acceleration_max_m_s2);
}

void SimVehicle::step(double t_s, double dt_s) {
  // a and v stay within their limits: a is a mean of values within, and clipping v to a ball that it started in
  // shortens the change of v.
  a_WB_ += (wanted_acceleration(t_s) - a_WB_) * std::min(1.0, dt_s / kThrustLag_s);
  const Eigen::Vector3d v_before_W = v_WB_;
  v_WB_ = limited(v_WB_ + a_WB_ * dt_s, limits_.speed_max_m_s);
  a_WB_ = (v_WB_ - v_before_W) / dt_s;
  p_WB_ += 0.5 * (v_before_W + v_WB_) * dt_s;
  turn(dt_s);
}

void SimVehicle::turn(double dt_s) {
  if (setpoint_.yaw_rad) {
    const double error_rad = std::remainder(*setpoint_.yaw_rad - yaw_rad_, 2.0 * std::numbers::pi);
    yaw_rad_ += std::clamp(error_rad, -kYawRateMax_rad_s * dt_s, kYawRateMax_rad_s * dt_s);
  }
  const Eigen::Quaterniond q_before = q_WB_;
  q_WB_ = attitude(a_WB_, yaw_rad_);
  const Eigen::AngleAxisd turned(q_before.conjugate() * q_WB_);
  w_WB_B_ = turned.axis() * (turned.angle() / dt_s);
}

StampedPose SimVehicle::pose() const {
  const Eigen::Quaterniond q_BW = q_WB_.conjugate();
  return {.p_WB = p_WB_, .q_WB = q_WB_, .v_WB_B = q_BW * v_WB_, .w_WB_B = w_WB_B_, .a_WB_B = q_BW * a_WB_};
}

}  // namespace comptonaut
