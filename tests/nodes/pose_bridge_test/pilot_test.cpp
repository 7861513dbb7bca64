// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/pilot.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "perfect_vehicle.h"

namespace comptonaut {
namespace {

using Points = std::vector<Eigen::Vector3d>;
const Points kSquare{{20, 0, 2}, {20, 20, 2}, {0, 20, 2}, {0, 0, 2}};

TEST(Pilot, StaysWhereItIsBeforeAPlanComes) {
  PerfectVehicle vehicle({}, {3, 4, 2});
  vehicle.step_until(60);
  EXPECT_EQ(vehicle.pose.p_WB, Eigen::Vector3d(3, 4, 2));
  EXPECT_EQ(vehicle.pilot.hold_reason(), "no plan yet");
}

TEST(Pilot, FliesAPlanToItsEnd) {
  PerfectVehicle vehicle({.plan_timeout_s = 100}, {0, 0, 2});
  vehicle.step();
  vehicle.pilot.take_plan(plan_for(1, 7, kSquare), vehicle.now_s());
  std::int32_t waypoint = 0;
  for (int i = 0; i < 50 * 40; ++i) {
    vehicle.step();
    EXPECT_GE(vehicle.pilot.waypoint(), waypoint) << i;
    waypoint = vehicle.pilot.waypoint();
  }
  EXPECT_EQ(waypoint, 4);
  EXPECT_EQ(vehicle.pilot.plan_number(), 7);
  EXPECT_LT((vehicle.pose.p_WB - kSquare.back()).norm(), 1e-9);
}

TEST(Pilot, DoesNotNoticeAPlanThatIsTheRestOfTheFlownOne) {
  PerfectVehicle planned_once({.plan_timeout_s = 100}, {0, 0, 2}), replanned({}, {0, 0, 2});
  planned_once.step();
  replanned.step();
  planned_once.pilot.take_plan(plan_for(1, 0, kSquare), 0);
  replanned.pilot.take_plan(plan_for(1, 0, kSquare), 0);
  for (int i = 1; i < 50 * 20; ++i) {
    planned_once.step();
    replanned.step();
    ASSERT_EQ(planned_once.pose.p_WB, replanned.pose.p_WB) << "tick " << i;
    if (i % 50 != 0) continue;
    // What is left as a coordinator sees it that is up to one waypoint late.
    const auto left = kSquare.begin() + std::max(0, planned_once.pilot.waypoint() - i / 50 % 2);
    const auto passed = static_cast<std::int32_t>(left - kSquare.begin());
    const std::int32_t before = planned_once.pilot.waypoint();
    replanned.pilot.take_plan(plan_for(1, i, {left, kSquare.end()}), replanned.now_s());
    if (left == kSquare.end()) break;
    EXPECT_EQ(replanned.pilot.waypoint() + passed, before) << "tick " << i;
  }
  EXPECT_GT(count(replanned.pilot.counters(), "plans_continued"), 9);
}

TEST(Pilot, BendsIntoANewPlanWithinItsLimits) {
  Random random(1);
  PilotConfig config;
  PerfectVehicle vehicle(config, {0, 0, 2});
  vehicle.step();
  const double step_s = seconds(kTick_us);
  for (int number = 0; number < 300; ++number) {
    Points points;
    for (int i = 0; i < 3; ++i) points.push_back({random.uniform(0, 50), random.uniform(0, 50), 2});
    vehicle.pilot.take_plan(plan_for(1, number, points), vehicle.now_s());
    for (int i = 0; i < 1 + number % 60; ++i) {
      const Eigen::Vector3d before = vehicle.pose.v_WB_B;
      vehicle.step();
      const double change = (vehicle.pose.v_WB_B - before).norm();
      ASSERT_LE(change, config.limits.acceleration_max_m_s2 * step_s + 1e-6) << "plan " << number << ", tick " << i;
    }
  }
}

TEST(Pilot, DoesNotTurnBackForAWaypointThatItHasPassedMeanwhile) {
  PerfectVehicle vehicle({.plan_timeout_s = 100}, {0, 0, 2});
  vehicle.step();
  vehicle.pilot.take_plan(plan_for(1, 0, {{5, 0, 2}, {40, 0, 2}}), 0);
  while (vehicle.pilot.waypoint() == 0) vehicle.step();
  vehicle.step_until(vehicle.now_s() + 0.2);
  vehicle.pilot.take_plan(plan_for(1, 1, {{5, 0, 2}, {40, 0, 2}, {40, 9, 2}}), vehicle.now_s());
  double x = vehicle.pose.p_WB.x();
  while (vehicle.pilot.waypoint() < 2) {
    vehicle.step();
    ASSERT_GE(vehicle.pose.p_WB.x(), x) << vehicle.now_s();
    x = vehicle.pose.p_WB.x();
  }
  vehicle.pilot.take_plan(plan_for(1, 2, {{5, 0, 2}}), vehicle.now_s());  // but it does where it is told to
  vehicle.step_until(60);
  EXPECT_LT((vehicle.pose.p_WB - Eigen::Vector3d(5, 0, 2)).norm(), 1e-9);
}

TEST(Pilot, RefusesOlderPlansAndThoseForOthers) {
  PerfectVehicle vehicle({.plan_timeout_s = 100}, {0, 0, 2});
  vehicle.step();
  vehicle.pilot.take_plan(plan_for(1, 5, {{10, 0, 2}}), 0);
  vehicle.pilot.take_plan(plan_for(1, 4, {{0, 50, 2}}), 0);
  vehicle.pilot.take_plan(plan_for(2, 6, {{0, 50, 2}}), 0);
  vehicle.pilot.take_plan(plan_for(1, 6, {{0, NAN, 2}}), 0);
  vehicle.step_until(20);
  EXPECT_LT((vehicle.pose.p_WB - Eigen::Vector3d(10, 0, 2)).norm(), 1e-9);
  EXPECT_EQ(count(vehicle.pilot.counters(), "plans_stale"), 1);
  EXPECT_EQ(count(vehicle.pilot.counters(), "plans_refused"), 2);
  Plan next_term = plan_for(1, 0, {{0, 0, 2}});
  next_term.term = 2;
  vehicle.pilot.take_plan(next_term, 20);
  vehicle.step_until(40);
  EXPECT_LT((vehicle.pose.p_WB - Eigen::Vector3d(0, 0, 2)).norm(), 1e-9);
}

TEST(Pilot, HoldsThenReturnsWhenPlansStopAndGoesOnWhenTheyComeAgain) {
  PerfectVehicle vehicle({}, {0, 0, 2});
  vehicle.step();
  vehicle.pilot.take_plan(plan_for(1, 0, {{500, 0, 3}}), 0);
  vehicle.step_until(2.9);
  EXPECT_EQ(vehicle.pilot.hold_reason(), "");
  vehicle.step_until(6);
  EXPECT_EQ(vehicle.pilot.hold_reason(), "no plan for 3 s");
  EXPECT_EQ(vehicle.pose.v_WB_B.norm(), 0.0);
  const Eigen::Vector3d held_at = vehicle.pose.p_WB;
  vehicle.step_until(14.9);
  EXPECT_EQ(vehicle.pose.p_WB, held_at);
  vehicle.step_until(40);
  EXPECT_EQ(vehicle.pilot.hold_reason(), "no plan for 15 s: returning home");
  EXPECT_LT((vehicle.pose.p_WB - Eigen::Vector3d(0, 0, held_at.z())).norm(), 1e-9);
  vehicle.pilot.take_plan(plan_for(1, 1, {{5, 0, 2}}), vehicle.now_s());
  vehicle.step_until(42.9);
  EXPECT_EQ(vehicle.pilot.hold_reason(), "");
  EXPECT_LT((vehicle.pose.p_WB - Eigen::Vector3d(5, 0, 2)).norm(), 1e-9);
}

TEST(Pilot, ClimbsBeforeItReturnsWhereItIsTooLow) {
  PerfectVehicle vehicle({.return_z_m = 12}, {0, 0, 2});
  vehicle.step();
  vehicle.pilot.take_plan(plan_for(1, 0, {{30, 0, 3}}), 0);
  vehicle.step_until(14.9);
  const Eigen::Vector3d held_at = vehicle.pose.p_WB;
  EXPECT_LT(held_at.z(), 4.0);
  for (int i = 0; i < 50 * 60; ++i) {
    vehicle.step();
    const Eigen::Vector3d& p_W = vehicle.pose.p_WB;
    EXPECT_TRUE((p_W - held_at).head<2>().norm() < 0.5 || p_W.z() > 11.5) << p_W.transpose();
  }
  EXPECT_LT((vehicle.pose.p_WB - Eigen::Vector3d(0, 0, 12)).norm(), 1e-9);
}

// A leader whose time ran ahead has gone; another one's is right, and its numbers are lower.
TEST(Pilot, TakesALowerNumberOnceNoPlanHasComeForLong) {
  PerfectVehicle vehicle({}, {0, 0, 2});
  vehicle.step();
  Plan plan = plan_for(1, 1'000, {{50, 0, 2}});
  plan.term = 2;
  vehicle.pilot.take_plan(plan, 0);
  Plan lower = plan_for(1, 700, {{0, 5, 2}}), deposed = plan_for(1, 2'000, {{0, -5, 2}});
  lower.term = 2;
  vehicle.step_until(2.9);
  vehicle.pilot.take_plan(lower, vehicle.now_s());
  EXPECT_EQ(vehicle.pilot.plan_number(), 1'000);
  vehicle.step_until(3.5);
  vehicle.pilot.take_plan(deposed, vehicle.now_s());
  EXPECT_EQ(vehicle.pilot.plan_number(), 1'000);
  vehicle.pilot.take_plan(lower, vehicle.now_s());
  EXPECT_EQ(vehicle.pilot.plan_number(), 700);
  vehicle.pilot.take_plan(plan, vehicle.now_s() + 0.1);
  EXPECT_EQ(vehicle.pilot.plan_number(), 1'000) << "both lead: the greater number counts";
}

TEST(Pilot, TakesAPlanThatCameBeforeTheFirstPose) {
  PerfectVehicle vehicle({.plan_timeout_s = 100}, {0, 0, 2});
  vehicle.pilot.take_plan(plan_for(1, 0, {{50, 50, 2}}), 0);
  vehicle.pilot.take_plan(plan_for(1, 1, {{9, 0, 2}}), 0);
  vehicle.step_until(20);
  EXPECT_LT((vehicle.pose.p_WB - Eigen::Vector3d(9, 0, 2)).norm(), 1e-9);
}

TEST(Pilot, StartsFromWhereTheVehicleIsWhenItIsFarFromItsSetpoint) {
  PerfectVehicle vehicle({.plan_timeout_s = 100}, {0, 0, 2});
  vehicle.step();
  vehicle.pose.p_WB = {0, 30, 2};  // blown away
  vehicle.pilot.take_plan(plan_for(1, 0, {{10, 30, 2}}), 0);
  vehicle.pose.utime += kTick_us;
  (void)vehicle.pilot.steer(vehicle.pose, {}, 0);
  vehicle.pose.p_WB = {0, 30, 2};
  vehicle.pilot.take_plan(plan_for(1, 1, {{10, 30, 2}, {20, 30, 2}}), 0);
  vehicle.step();
  EXPECT_LT((vehicle.pose.p_WB - Eigen::Vector3d(0, 30, 2)).norm(), 0.1);
}

}  // namespace
}  // namespace comptonaut
