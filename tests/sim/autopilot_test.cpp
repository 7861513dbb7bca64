// SPDX-License-Identifier: BSD-3-Clause
#include "sim/autopilot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "start_time.h"

namespace comptonaut {
namespace {

const VehicleLimits kLimits{.speed_max_m_s = 8.0, .acceleration_max_m_s2 = 4.0};

SimAutopilot autopilot(double sigma_m = 0.0, double sigma_rad = 0.0) {
  return {2, SimVehicle(kLimits, {1, 3, 2}), PoseNoise(sigma_m, sigma_rad, 2.0, Random(1)), kStart_us, 300.0};
}

std::vector<MavlinkMessage> messages(SimAutopilot& autopilot) {
  MavlinkParser parser;
  std::vector<MavlinkMessage> result;
  for (const auto& frame : autopilot.frames()) {
    for (const ReceivedMavlink& received : parser.on_bytes(frame)) {
      EXPECT_EQ(received.from.system, 2);
      result.push_back(received.message);
    }
  }
  return result;
}

Odometry last_odometry(SimAutopilot& autopilot) { return std::get<Odometry>(messages(autopilot).back()); }

void send(SimAutopilot& autopilot, const SetPositionTarget& target) {
  autopilot.on_mavlink(mavlink_frame(target, {255, kComponentOnboardComputer}, 0));
}

void fly(SimAutopilot& autopilot, int steps) {
  for (int i = 0; i < steps; ++i) autopilot.fly(10'000);
}

TEST(SimAutopilot, SendsFiftyOdometriesAndOneHeartbeatAndItsBatteryASecond) {
  SimAutopilot pilot = autopilot();
  int odometries = 0, heartbeats = 0;
  std::vector<int> battery_percent;
  for (int i = 0; i < 300; ++i) {
    for (const MavlinkMessage& message : messages(pilot)) {
      odometries += std::holds_alternative<Odometry>(message);
      heartbeats += std::holds_alternative<Heartbeat>(message);
      if (const auto* status = std::get_if<SysStatus>(&message)) {
        battery_percent.push_back(status->battery_remaining_percent);
      }
    }
    pilot.fly(10'000);
  }
  EXPECT_EQ(odometries, 150);
  EXPECT_EQ(heartbeats, 3);
  EXPECT_EQ(battery_percent, (std::vector{100, 99, 99}));
}

TEST(SimAutopilot, TellsItsPoseNorthEastDownInUnixTime) {
  SimAutopilot pilot = autopilot();
  fly(pilot, 2);
  const Odometry odometry = last_odometry(pilot);
  EXPECT_EQ(odometry.time_usec, static_cast<std::uint64_t>(kStart_us + 20'000));
  EXPECT_EQ(odometry.position_m, (std::array<float, 3>{3, 1, -2}));
  // Nose to the east, level: a yaw of 90 degrees from north.
  const double half = std::numbers::sqrt2 / 2.0;
  EXPECT_NEAR(std::abs(odometry.q[0] * half + odometry.q[3] * half), 1.0, 1e-6);
}

TEST(SimAutopilot, FliesToASetpointInItsOwnFrame) {
  SimAutopilot pilot = autopilot();
  SetPositionTarget target{.target_system = 2, .type_mask = kIgnoreVelocity | kIgnoreAcceleration | kIgnoreYawRate};
  target.position_m = {13, 1, -2};  // 10 m to the north
  target.yaw_rad = 0.0F;            // nose to the north
  for (int i = 0; i < 100; ++i) {
    send(pilot, target);
    fly(pilot, 10);
  }
  EXPECT_LT((pilot.vehicle().p_WB() - Eigen::Vector3d(1, 13, 2)).norm(), 0.02);
  EXPECT_NEAR(yaw_of(pilot.vehicle().pose().q_WB), 0.5 * std::numbers::pi, 0.01);
  const Odometry odometry = last_odometry(pilot);
  EXPECT_NEAR(std::abs(odometry.q[0]), 1.0, 1e-3) << "nose to the north is no yaw";
}

TEST(SimAutopilot, VelocityIsForwardRightDown) {
  SimAutopilot pilot = autopilot();
  SetPositionTarget target{.target_system = 2, .type_mask = kIgnoreVelocity | kIgnoreYaw};
  target.position_m = {33, 1, -2};  // to the north, which is left of a nose to the east
  for (int i = 0; i < 10; ++i) {
    send(pilot, target);
    fly(pilot, 10);
  }
  EXPECT_LT(last_odometry(pilot).velocity_m_s[1], -2.0F);
}

TEST(SimAutopilot, IgnoresSetpointsOfOthersOtherFramesAndNoNumbers) {
  SimAutopilot pilot = autopilot();
  SetPositionTarget target{.target_system = 3};
  target.position_m = {33, 1, -2};
  send(pilot, target);
  send(pilot, {.target_system = 2, .coordinate_frame = 8, .position_m = {33, 1, -2}});
  send(pilot, {.target_system = 2, .type_mask = kIgnorePosition, .position_m = {33, 1, -2}});
  send(pilot, {.target_system = 2, .position_m = {std::numeric_limits<float>::quiet_NaN(), 1, -2}});
  fly(pilot, 100);
  EXPECT_LT((pilot.vehicle().p_WB() - Eigen::Vector3d(1, 3, 2)).norm(), 1e-9);
}

TEST(PoseNoise, IsAsLargeAndAsLastingAsItSays) {
  PoseNoise noise(0.02, 0.01, 2.0, Random(7));
  const StampedPose truth{.p_WB = {1, 2, 3}};
  double square_m2 = 0.0, square_rad2 = 0.0, product_m2 = 0.0;
  Eigen::Vector3d before = Eigen::Vector3d::Zero();
  constexpr int kSteps = 20'000;  // of 2 s: one correlation time
  for (int i = 0; i < kSteps; ++i) {
    const StampedPose pose = noise.disturbed(truth);
    const Eigen::Vector3d error_m = pose.p_WB - truth.p_WB;
    square_m2 += error_m.squaredNorm() / 3;
    product_m2 += error_m.dot(before) / 3;
    square_rad2 += std::pow(pose.q_WB.angularDistance(truth.q_WB), 2) / 3;
    before = error_m;
    noise.step(2.0);
  }
  EXPECT_NEAR(std::sqrt(square_m2 / kSteps), 0.02, 0.0004);
  EXPECT_NEAR(std::sqrt(square_rad2 / kSteps), 0.01, 0.0002);
  EXPECT_NEAR(product_m2 / square_m2, std::exp(-1.0), 0.02);
}

}  // namespace
}  // namespace comptonaut
