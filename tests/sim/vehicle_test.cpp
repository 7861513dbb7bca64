// SPDX-License-Identifier: BSD-3-Clause
#include "sim/vehicle.h"

#include <gtest/gtest.h>

#include "core/random.h"
#include "flight/trajectory.h"
#include "sim/fit.h"

namespace comptonaut {
namespace {

constexpr double kTick_s = 0.01;
const VehicleLimits kLimits{.speed_max_m_s = 8.0, .acceleration_max_m_s2 = 4.0};
const Eigen::Vector3d kStart_W(1, 1, 2);

TEST(SimVehicle, NeverExceedsItsLimitsWhateverTheSetpoints) {
  Random random(1);
  SimVehicle vehicle(kLimits, kStart_W);
  for (int i = 0; i < 100'000; ++i) {
    if (random.uniform() < 0.02) {
      vehicle.command({.p_W = 100.0 * random.unit_vector(), .v_W = 20.0 * random.unit_vector()}, i * kTick_s);
    }
    const Eigen::Vector3d p_before = vehicle.p_WB(), v_before = vehicle.v_WB();
    vehicle.step(i * kTick_s, kTick_s);
    ASSERT_LE(vehicle.v_WB().norm(), kLimits.speed_max_m_s * (1 + 1e-12)) << "step " << i;
    ASSERT_LE((vehicle.v_WB() - v_before).norm() / kTick_s, kLimits.acceleration_max_m_s2 * (1 + 1e-9)) << "step " << i;
    ASSERT_LE((vehicle.p_WB() - p_before).norm() / kTick_s, kLimits.speed_max_m_s * (1 + 1e-9)) << "step " << i;
  }
}

TEST(SimVehicle, HoldsAtItsStartWithoutSetpoints) {
  SimVehicle vehicle(kLimits, kStart_W);
  for (int i = 0; i < 1000; ++i) vehicle.step(i * kTick_s, kTick_s);
  EXPECT_LT((vehicle.p_WB() - kStart_W).norm(), 1e-9);
}

/// Largest distance from a setpoint that speeds up along x with 3 m/s^2 to 6 m/s and is told 20 times a second.
double largest_lag_m(bool with_acceleration) {
  SimVehicle vehicle(kLimits, kStart_W);
  double largest_m = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const double t_s = i * kTick_s, speeding_s = std::min(t_s, 2.0);
    const Eigen::Vector3d p_W =
        kStart_W + Eigen::Vector3d(1.5 * speeding_s * speeding_s + 6.0 * (t_s - speeding_s), 0, 0);
    Setpoint setpoint{.p_W = p_W, .v_W = {3.0 * speeding_s, 0, 0}};
    if (with_acceleration && t_s < 2.0) setpoint.a_W.x() = 3.0;
    if (i % 5 == 0) vehicle.command(setpoint, t_s);
    largest_m = std::max(largest_m, (vehicle.p_WB() - p_W).norm());
    vehicle.step(t_s, kTick_s);
  }
  EXPECT_NEAR(vehicle.v_WB().x(), 6.0, 0.05);
  return largest_m;
}

TEST(SimVehicle, FollowsAMovingSetpointMoreCloselyWhereItKnowsTheAcceleration) {
  EXPECT_LT(largest_lag_m(true), 0.2);
  EXPECT_LT(largest_lag_m(false), 0.7);
}

TEST(SimVehicle, StopsWhereItIsToldWhereAPlanLeavesSomethingToItsControl) {
  const auto overshoot_m = [](double acceleration_m_s2) {
    SimVehicle vehicle(kLimits, kStart_W);
    const Eigen::Vector3d goal_W = kStart_W + Eigen::Vector3d(40, 0, 0);
    const std::vector<Waypoint> way{{.p_W = goal_W}};
    const Trajectory plan(kStart_W, Eigen::Vector3d::Zero(), way,
                          {.speed_max_m_s = kLimits.speed_max_m_s, .acceleration_max_m_s2 = acceleration_m_s2});
    double farthest_m = 0.0;
    for (int i = 0; i < 1000; ++i) {
      const Motion wanted = plan.sample(i * kTick_s);
      vehicle.command({.p_W = wanted.p_W, .v_W = wanted.v_W, .a_W = wanted.a_W}, i * kTick_s);
      vehicle.step(i * kTick_s, kTick_s);
      farthest_m = std::max(farthest_m, vehicle.p_WB().x() - goal_W.x());
    }
    return farthest_m;
  };
  EXPECT_LT(overshoot_m(planned_acceleration_m_s2({.acceleration_max_m_s2 = kLimits.acceleration_max_m_s2})), 0.05);
  EXPECT_GT(overshoot_m(kLimits.acceleration_max_m_s2), 0.5);
}

TEST(SimVehicle, BrakesAndHoldsWhenSetpointsStop) {
  SimVehicle vehicle(kLimits, kStart_W);
  for (int i = 0; i < 300; ++i) {
    vehicle.command({.p_W = kStart_W + Eigen::Vector3d(0.08 * i, 0, 0), .v_W = {8, 0, 0}}, i * kTick_s);
    vehicle.step(i * kTick_s, kTick_s);
  }
  const Eigen::Vector3d p_lost = vehicle.p_WB();
  ASSERT_GT(vehicle.v_WB().x(), 6.0);
  for (int i = 300; i < 1300; ++i) vehicle.step(i * kTick_s, kTick_s);
  EXPECT_LT(vehicle.v_WB().norm(), 0.01);
  EXPECT_LT((vehicle.p_WB() - p_lost).norm(), 8.0 * 0.5 + 8.0 * 8.0 / (2 * 4.0) + 3.0);
}

TEST(SimVehicle, TiltsIntoItsAccelerationAndTurnsToItsYaw) {
  SimVehicle vehicle(kLimits, kStart_W);
  for (int i = 0; i < 50; ++i) {
    vehicle.command({.p_W = kStart_W + Eigen::Vector3d(30, 0, 0), .yaw_rad = 0.2}, i * kTick_s);
    vehicle.step(i * kTick_s, kTick_s);
  }
  const StampedPose pose = vehicle.pose();
  const Eigen::Vector3d thrust_W = pose.q_WB * Eigen::Vector3d::UnitZ();
  EXPECT_NEAR(std::atan2(thrust_W.x(), thrust_W.z()), std::atan2(4.0, 9.81), 0.02);
  EXPECT_NEAR((pose.q_WB * pose.v_WB_B - vehicle.v_WB()).norm(), 0.0, 1e-12);
  EXPECT_NEAR(yaw_of(pose.q_WB), 0.2, 0.02);
}

}  // namespace
}  // namespace comptonaut
