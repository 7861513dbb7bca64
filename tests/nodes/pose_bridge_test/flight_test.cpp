// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "nodes/pose_bridge.h"
#include "perfect_vehicle.h"

namespace comptonaut {
namespace {

/// A point mass that follows its setpoints with limited acceleration, in the autopilot's own frames.
class TinyAutopilot {
 public:
  explicit TinyAutopilot(const Eigen::Vector3d& p_N) : p_N_(p_N), target_N_(p_N) {}

  std::vector<std::uint8_t> odometry() {
    Odometry m;
    m.time_usec = static_cast<std::uint64_t>(kStart_us + elapsed_us_);
    for (int i = 0; i < 3; ++i) m.position_m[static_cast<std::size_t>(i)] = static_cast<float>(p_N_[i]);
    // Nose to the east: forward is east (N's y), right is south (N's -x).
    m.q = {std::sqrt(0.5F), 0, 0, std::sqrt(0.5F)};
    m.velocity_m_s = {static_cast<float>(v_N_.y()), static_cast<float>(-v_N_.x()), static_cast<float>(v_N_.z())};
    return mavlink_frame(m, {1, 1}, sequence_++);
  }
  std::vector<std::uint8_t> heartbeat() {
    const Heartbeat m{.type = kTypeQuadrotor,
                      .autopilot = kAutopilotPx4,
                      .base_mode = kBaseModeCustom | kBaseModeArmed,
                      .custom_mode = 6 << 16,
                      .system_status = kStateActive};
    return mavlink_frame(m, {1, 1}, sequence_++);
  }
  std::vector<std::uint8_t> sys_status(std::int8_t battery_percent) {
    return mavlink_frame(SysStatus{.battery_remaining_percent = battery_percent}, {1, 1}, sequence_++);
  }
  void on_mavlink(std::span<const std::uint8_t> bytes) {
    for (const auto& received : parser_.on_bytes(bytes)) {
      const auto* m = std::get_if<SetPositionTarget>(&received.message);
      if (m == nullptr) continue;
      ++setpoints_;
      EXPECT_EQ(m->target_system, 1);
      EXPECT_EQ(m->coordinate_frame, kFrameLocalNed);
      EXPECT_NEAR(m->yaw_rad, M_PI / 2, 1e-6);
      target_N_ = {m->position_m[0], m->position_m[1], m->position_m[2]};
      v_target_N_ = {m->velocity_m_s[0], m->velocity_m_s[1], m->velocity_m_s[2]};
      a_target_N_ = {m->acceleration_m_s2[0], m->acceleration_m_s2[1], m->acceleration_m_s2[2]};
    }
  }
  void fly(Utime duration_us) {
    const double dt = seconds(duration_us);
    Eigen::Vector3d a_N = a_target_N_ + 4.0 * (v_target_N_ - v_N_) + 4.0 * (target_N_ - p_N_);
    if (a_N.norm() > 6.0) a_N *= 6.0 / a_N.norm();
    p_N_ += dt * v_N_ + 0.5 * dt * dt * a_N;
    v_N_ += dt * a_N;
    target_N_ += dt * v_target_N_;
    elapsed_us_ += duration_us;
  }
  [[nodiscard]] Eigen::Vector3d p_W() const { return {p_N_.y(), p_N_.x(), -p_N_.z()}; }
  [[nodiscard]] double now_s() const { return seconds(elapsed_us_); }
  [[nodiscard]] int setpoints() const { return setpoints_; }

 private:
  Eigen::Vector3d p_N_, v_N_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d target_N_, v_target_N_ = Eigen::Vector3d::Zero(), a_target_N_ = Eigen::Vector3d::Zero();
  Utime elapsed_us_ = 0;
  MavlinkParser parser_;
  std::uint8_t sequence_ = 0;
  int setpoints_ = 0;
};

struct Loop {
  PoseBridge bridge;
  TinyAutopilot autopilot;
  std::vector<StampedPose> poses;

  Loop(const PoseBridgeConfig& config, const Eigen::Vector3d& p_N) : bridge(config), autopilot(p_N) {}

  void step() {
    const auto output = bridge.on_mavlink(autopilot.odometry(), autopilot.now_s());
    if (output.pose) poses.push_back(*output.pose);
    for (const auto& frame : output.to_autopilot) autopilot.on_mavlink(frame);
    autopilot.fly(kTick_us);
  }
};

double distance_from_square(const Eigen::Vector3d& p_W, double edge_m) {
  const Eigen::Vector2d q = p_W.head<2>() - Eigen::Vector2d(0.5, 0.5) * edge_m;
  const Eigen::Vector2d outside = (q.cwiseAbs().array() - 0.5 * edge_m).matrix();
  return outside.maxCoeff() > 0 ? outside.cwiseMax(0.0).norm() : -outside.maxCoeff();
}

TEST(PoseBridge, FliesASquareBehindMavlinkAndStaysOnIt) {
  Loop loop({}, {0, 0, -2});
  ASSERT_TRUE(loop.bridge.on_mavlink(loop.autopilot.heartbeat(), 0.0).to_autopilot.empty());
  loop.step();
  const std::vector<Eigen::Vector3d> square{{20, 0, 2}, {20, 20, 2}, {0, 20, 2}, {0, 0, 2}};
  double farthest_m = 0.0;
  for (int i = 0; i < 50 * 30; ++i) {
    if (i % 50 == 0) {  // the coordinator plans anew each second
      const auto first = std::clamp(loop.bridge.on_timer(loop.autopilot.now_s()).vehicle->waypoint, 0, 3);
      if (i == 0) loop.bridge.on_plan(plan_for(1, 0, square), 0.0);
      if (i > 0) loop.bridge.on_plan(plan_for(1, 0, square), loop.autopilot.now_s());
      EXPECT_GE(first, 0);
    }
    loop.step();
    farthest_m = std::max(farthest_m, distance_from_square(loop.autopilot.p_W(), 20));
    EXPECT_NEAR(loop.autopilot.p_W().z(), 2.0, 0.05) << i;
  }
  EXPECT_LT(farthest_m, MotionLimits{}.corner_deviation_max_m + 0.25);
  EXPECT_LT((loop.autopilot.p_W() - square.back()).norm(), 0.05);
  EXPECT_NEAR(loop.autopilot.setpoints(), 30 * 20, 2);  // 20 a second, though the odometry comes 50 times
  ASSERT_EQ(loop.poses.size(), 50u * 30u + 1u);
  EXPECT_LT((loop.poses.back().p_WB - loop.autopilot.p_W()).norm(), 0.2);
  EXPECT_NEAR(yaw_of(loop.poses.back().q_WB), 0.0, 1e-6);
}

TEST(PoseBridge, TellsTheVehiclesStateOnceASecond) {
  Loop loop({}, {1, 2, -3});
  auto vehicle = *loop.bridge.on_timer(0.0).vehicle;
  EXPECT_FALSE(vehicle.connected);
  EXPECT_TRUE(std::isnan(vehicle.p_WHome.x()));
  EXPECT_EQ(loop.bridge.state(0.0), "no heartbeat from the autopilot");

  (void)loop.bridge.on_mavlink(loop.autopilot.heartbeat(), 1.0);
  EXPECT_EQ(loop.bridge.state(1.0), "no odometry yet");
  loop.step();
  vehicle = *loop.bridge.on_timer(2.0).vehicle;
  EXPECT_TRUE(vehicle.connected);
  EXPECT_TRUE(vehicle.armed);
  EXPECT_EQ(vehicle.mode, "offboard");
  EXPECT_EQ(vehicle.sender, 1);
  EXPECT_EQ(vehicle.utime, kStart_us);
  EXPECT_TRUE(vehicle.p_WHome.isApprox(Eigen::Vector3d(2, 1, 3)));
  EXPECT_EQ(vehicle.hold_reason, "no plan yet");
  EXPECT_FALSE(loop.bridge.on_timer(9.0).vehicle->connected);
}

TEST(PoseBridge, TellsTheBatteryAsLongAsTheAutopilotDoes) {
  Loop loop({}, {1, 2, -3});
  const auto battery_percent = [&](double now_s) { return loop.bridge.on_timer(now_s).vehicle->battery_percent; };
  (void)loop.bridge.on_mavlink(loop.autopilot.heartbeat(), 0.0);
  EXPECT_TRUE(std::isnan(battery_percent(0.0))) << "not told yet";
  (void)loop.bridge.on_mavlink(loop.autopilot.sys_status(63), 1.0);
  EXPECT_EQ(battery_percent(1.0), 63.0);
  EXPECT_TRUE(std::isnan(battery_percent(9.0))) << "no heartbeat";
  (void)loop.bridge.on_mavlink(loop.autopilot.heartbeat(), 10.0);
  (void)loop.bridge.on_mavlink(loop.autopilot.sys_status(-1), 10.0);
  EXPECT_TRUE(std::isnan(battery_percent(10.0))) << "it does not know";
  (void)loop.bridge.on_mavlink(loop.autopilot.sys_status(101), 10.0);
  EXPECT_TRUE(std::isnan(battery_percent(10.0))) << "no percentage";
}

TEST(PoseBridge, SendsAHeartbeatOfItsOwn) {
  PoseBridge bridge({});
  MavlinkParser parser;
  for (int i = 0; i < 3; ++i) {
    const auto output = bridge.on_timer(i);
    ASSERT_EQ(output.to_autopilot.size(), 1u);
    const auto received = parser.on_bytes(output.to_autopilot[0]);
    ASSERT_EQ(received.size(), 1u);
    EXPECT_EQ(std::get<Heartbeat>(received[0].message).type, kTypeOnboardController);
    EXPECT_EQ(received[0].from, (MavlinkAddress{1, kComponentOnboardComputer}));
  }
  EXPECT_EQ(parser.counters().lost, 0);
}

TEST(PoseBridge, ListensToItsOwnAutopilotOnly) {
  PoseBridgeConfig config;
  config.pilot.mav = 2;
  PoseBridge bridge(config);
  TinyAutopilot first({0, 0, -2});
  EXPECT_FALSE(bridge.on_mavlink(first.odometry(), 0.0).pose);
  EXPECT_EQ(count(bridge.counters(), "mavlink_other_systems"), 1);
}

TEST(PoseBridge, FliesOnWithGarbageOnTheLinkAndCrashesOnNone) {
  Random random(1);
  Loop loop({.heartbeat_timeout_s = 1e6, .pilot = {.plan_timeout_s = 1e6, .return_timeout_s = 2e6}}, {0, 0, -2});
  loop.step();
  loop.bridge.on_plan(plan_for(1, 0, {{20, 0, 2}}), 0.0);
  for (int i = 0; i < 50 * 10; ++i) {
    std::vector<std::uint8_t> garbage = loop.autopilot.heartbeat();
    for (auto& byte : garbage) byte ^= static_cast<std::uint8_t>(random.uniform() < 0.3 ? random() : 0);
    (void)loop.bridge.on_mavlink(garbage, 0.0);
    loop.step();
  }
  EXPECT_LT((loop.autopilot.p_W() - Eigen::Vector3d(20, 0, 2)).norm(), 0.1);
}

TEST(PoseBridge, FliesTheSameWayWhereverTheLocalOriginLies) {
  Loop here({}, {0, 0, -2});
  Loop there({.p_WN_m = {100, -50, 7}}, {50, -100, 5});  // W origin in N: 50 north, 100 west, 7 down
  for (Loop* loop : {&here, &there}) {
    loop->step();
    loop->bridge.on_plan(plan_for(1, 0, {{5, 8, 2}}), 0.0);
    for (int i = 0; i < 100; ++i) loop->step();
  }
  EXPECT_LT((here.poses.back().p_WB - there.poses.back().p_WB).norm(), 1e-4);
}

TEST(PoseBridge, StopsForAnotherMavWhateverItsClockSays) {
  for (const Utime off_s : {0, -300, 300}) {
    PoseBridgeConfig config{.pilot = {.plan_timeout_s = 1e6, .return_timeout_s = 2e6}};
    Loop loop(config, {0, 0, -2});
    loop.step();
    loop.bridge.on_plan(plan_for(1, 0, {{40, 0, 2}}), 0.0);
    StampedPose other{.p_WB = {20, 0, 2}};
    for (int i = 0; i < 50 * 10; ++i) {
      other.utime = loop.poses.back().utime + off_s * kSecond_us;
      if (i % 5 == 0) loop.bridge.on_other_pose(2, other);
      loop.step();
    }
    EXPECT_LT(loop.autopilot.p_W().x(), 18.5) << off_s << " s off";
  }
}

TEST(PoseBridgeConfig, InTheFileIsWhatTheCodeSays) {
  const auto config = load_config(std::filesystem::path(COMPTONAUT_SOURCE_DIR) / "config" / "pose-bridge.yaml",
                                  read_pose_bridge_config);
  const PoseBridgeConfig code;
  EXPECT_EQ(config.heartbeat_timeout_s, code.heartbeat_timeout_s);
  EXPECT_EQ(config.pilot.plan_timeout_s, code.pilot.plan_timeout_s);
  EXPECT_EQ(config.pilot.return_timeout_s, code.pilot.return_timeout_s);
  EXPECT_EQ(config.pilot.return_speed_m_s, code.pilot.return_speed_m_s);
  EXPECT_EQ(config.pilot.return_z_m, code.pilot.return_z_m);
  EXPECT_EQ(config.pilot.tracking_error_max_m, code.pilot.tracking_error_max_m);
  EXPECT_EQ(config.pilot.limits.speed_max_m_s, code.pilot.limits.speed_max_m_s);
  EXPECT_EQ(config.pilot.limits.acceleration_max_m_s2, code.pilot.limits.acceleration_max_m_s2);
  EXPECT_EQ(config.pilot.limits.corner_deviation_max_m, code.pilot.limits.corner_deviation_max_m);
  EXPECT_EQ(config.pilot.separation.distance_min_m, code.pilot.separation.distance_min_m);
  EXPECT_EQ(config.pilot.separation.give_way_extra_m, code.pilot.separation.give_way_extra_m);
  EXPECT_EQ(config.pilot.separation.step_aside_after_s, code.pilot.separation.step_aside_after_s);
  EXPECT_TRUE(std::isnan(config.pilot.p_WHome_m.x()));
}

TEST(PoseBridgeConfig, RefusesAReturnBeforeTheHold) {
  EXPECT_THROW((void)parse_config("{plan_timeout_s: 9, return_timeout_s: 8}", "a.yaml", read_pose_bridge_config),
               ConfigError);
}

}  // namespace
}  // namespace comptonaut
