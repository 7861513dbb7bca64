// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/separation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "core/random.h"
#include "perfect_vehicle.h"

namespace comptonaut {
namespace {

/// MAVs 1, 2, ... that all hear each other's poses, `late` ticks old and off by noise_m.
struct Fleet {
  std::vector<std::unique_ptr<PerfectVehicle>> vehicles;
  std::vector<Others> history;
  std::size_t late = 3;
  double noise_m;
  double nearest_m = 1e9;
  Random random{1};

  explicit Fleet(const std::vector<Eigen::Vector3d>& starts, double noise_m_ = 0.0) : noise_m(noise_m_) {
    for (std::size_t i = 0; i < starts.size(); ++i) {
      PilotConfig config{.mav = static_cast<int>(i) + 1, .plan_timeout_s = 1e6, .return_timeout_s = 2e6};
      vehicles.push_back(std::make_unique<PerfectVehicle>(config, starts[i]));
      vehicles.back()->step();
    }
  }
  PerfectVehicle& mav(int number) { return *vehicles[static_cast<std::size_t>(number) - 1]; }
  void send(int number, const std::vector<Eigen::Vector3d>& points, std::int64_t plan_number = 0) {
    mav(number).pilot.take_plan(plan_for(number, plan_number, points), mav(number).now_s());
  }
  void fly(double duration_s) {
    for (double t = 0; t < duration_s; t += seconds(kTick_us)) {
      Others now;
      for (std::size_t i = 0; i < vehicles.size(); ++i) {
        StampedPose& heard = now[static_cast<int>(i) + 1] = vehicles[i]->pose;
        heard.p_WB += noise_m * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
        heard.v_WB_B += noise_m * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
      }
      history.push_back(now);
      const Others& heard = history[history.size() - std::min(history.size(), late)];
      for (const auto& vehicle : vehicles) vehicle->step(heard);
      for (std::size_t i = 0; i < vehicles.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
          nearest_m = std::min(nearest_m, (vehicles[i]->pose.p_WB - vehicles[j]->pose.p_WB).norm());
        }
      }
    }
  }
  [[nodiscard]] double from_goal_m(int number, const Eigen::Vector3d& goal_W) {
    return (mav(number).pose.p_WB - goal_W).norm();
  }
};

constexpr double kMin_m = SeparationConfig{}.distance_min_m - 0.1;

TEST(Separation, LetsMavsThatStayApartFlyAsPlanned) {
  Fleet fleet({{0, 0, 2}, {0, 10, 2}});
  fleet.send(1, {{40, 0, 2}});
  fleet.send(2, {{40, 10, 2}});
  fleet.fly(12);
  EXPECT_LT(fleet.from_goal_m(1, {40, 0, 2}), 1e-9);
  EXPECT_LT(fleet.from_goal_m(2, {40, 10, 2}), 1e-9);
  EXPECT_EQ(count(fleet.mav(2).pilot.counters(), "gave_way"), 0);
}

TEST(Separation, AtACrossingTheHigherNumberGivesWay) {
  Fleet fleet({{0, 20, 2}, {20, 0, 2}});
  fleet.send(1, {{40, 20, 2}});
  fleet.send(2, {{20, 40, 2}});
  fleet.fly(15);
  EXPECT_GE(fleet.nearest_m, kMin_m);
  EXPECT_EQ(count(fleet.mav(1).pilot.counters(), "gave_way"), 0);
  EXPECT_GE(count(fleet.mav(2).pilot.counters(), "gave_way"), 1);
  EXPECT_LT(fleet.from_goal_m(1, {40, 20, 2}), 1e-9);
  EXPECT_LT(fleet.from_goal_m(2, {20, 40, 2}), 1e-9);
}

TEST(Separation, TwoThatChangePlacesDoNotStandForEver) {
  for (const double offset : {0.0, 0.5, 1.5}) {
    Fleet fleet({{0, 0, 2}, {40, offset, 2}});
    fleet.send(1, {{40, offset, 2}});
    fleet.send(2, {{0, 0, 2}});
    fleet.fly(60);
    EXPECT_GE(fleet.nearest_m, kMin_m) << offset;
    EXPECT_LT(fleet.from_goal_m(1, {40, offset, 2}), 1e-6) << offset;
    EXPECT_LT(fleet.from_goal_m(2, {0, 0, 2}), 1e-6) << offset;
  }
}

TEST(Separation, NeitherOfTwoOnLanesTooNearChangesItsMindAtEveryStep) {
  for (const double lane_m : {1.2, 1.6, 1.8}) {
    for (double later_s = 0.0; later_s < 6.0; later_s += 0.2) {
      Fleet fleet({{20, 0, 2}, {50, lane_m, 2}}, 0.02);
      fleet.send(2, {{0, lane_m, 2}});
      fleet.fly(later_s);
      fleet.send(1, {{50, 0, 2}});
      fleet.fly(20);
      EXPECT_GE(fleet.nearest_m, kMin_m) << lane_m << " m, " << later_s << " s";
      for (const int mav : {1, 2}) {  // about once a second
        EXPECT_LE(count(fleet.mav(mav).pilot.counters(), "gave_way"), 25) << lane_m << " m, " << later_s << " s";
      }
    }
  }
}

TEST(Separation, TwoAtRestWhoseWaysCrossGetPastEachOther) {
  for (const double apart_m : {2.8, 3.0, 3.3, 3.45}) {
    const Eigen::Vector3d second(5.7 + 0.3 * apart_m, 7.2 - 0.95 * apart_m, 2);
    Fleet fleet({{5.7, 7.2, 2}, second});
    fleet.send(1, {{9.8, 2.8, 2}});
    fleet.send(2, {{3.1, 7.2, 2}});
    fleet.fly(40);
    EXPECT_GE(fleet.nearest_m, kMin_m) << apart_m;
    EXPECT_LT(fleet.from_goal_m(1, {9.8, 2.8, 2}), 1e-6) << apart_m;
    EXPECT_LT(fleet.from_goal_m(2, {3.1, 7.2, 2}), 1e-6) << apart_m;
  }
}

TEST(Separation, StopsBeforeAMavThatHangsInItsWayWhateverItsNumber) {
  for (const int mover : {1, 2}) {
    Fleet fleet(mover == 1 ? std::vector<Eigen::Vector3d>{{30, 0, 2}, {0, 0, 2}}
                           : std::vector<Eigen::Vector3d>{{0, 0, 2}, {30, 0, 2}});
    fleet.send(mover, {{-30, 0, 2}});
    fleet.fly(20);
    EXPECT_GE(fleet.nearest_m, kMin_m) << "MAV " << mover;
    EXPECT_GT(fleet.mav(mover).pose.p_WB.x(), 0.0) << "MAV " << mover;
    fleet.send(mover, {{15, 20, 2}, {-30, 20, 2}}, 1);  // a plan around it
    fleet.fly(20);
    EXPECT_LT(fleet.from_goal_m(mover, {-30, 20, 2}), 1e-6) << "MAV " << mover;
    EXPECT_GE(fleet.nearest_m, kMin_m) << "MAV " << mover;
  }
}

TEST(Separation, LetsMavsThatStartTooNearGetApart) {
  Fleet fleet({{0, 0, 2}, {1, 0, 2}, {0.5, 1, 2}});
  fleet.send(1, {{-20, 0, 2}});
  fleet.send(2, {{20, 0, 2}});
  fleet.send(3, {{0.5, 20, 2}});
  fleet.fly(20);
  EXPECT_GE(fleet.nearest_m, 0.95);
  EXPECT_LT(fleet.from_goal_m(1, {-20, 0, 2}), 1e-6);
  EXPECT_LT(fleet.from_goal_m(2, {20, 0, 2}), 1e-6);
  EXPECT_LT(fleet.from_goal_m(3, {0.5, 20, 2}), 1e-6);
}

TEST(Separation, GetsAwayFromOneThatStandsTooNearThoughPosesAreNoisy) {
  for (const int leaves : {1, 2}) {
    Fleet fleet({{0, 0, 2}, {1.3, 0, 2}}, 0.02);
    const Eigen::Vector3d goal_W = leaves == 2 ? Eigen::Vector3d(4, 0, 2) : Eigen::Vector3d(-3, 0, 2);
    fleet.send(leaves, {goal_W});
    fleet.fly(3);
    EXPECT_LT(fleet.from_goal_m(leaves, goal_W), 0.1) << "MAV " << leaves;
  }
}

TEST(Separation, ForgetsAMavThatHasNotBeenHeardOf) {
  const StampedPose seen{.utime = kStart_us, .p_WB = {10, 0, 2}};
  const Trajectory towards({0, 0, 2}, {8, 0, 0}, std::vector<Waypoint>{{{40, 0, 2}, 8, 0}}, MotionLimits{});
  const Others others{{1, seen}};
  EXPECT_EQ(must_stop_for({2, kStart_us + kSecond_us, towards, 0.0, false}, others, {}, 4.0), 1);
  EXPECT_EQ(must_stop_for({2, kStart_us + 3 * kSecond_us, towards, 0.0, false}, others, {}, 4.0), std::nullopt);
}

TEST(Separation, HoldsForRandomFleetsWithCarelessPlans) {
  Random random(1);
  for (int run = 0; run < 60; ++run) {
    const int n = 2 + run % 5;
    std::vector<Eigen::Vector3d> starts;
    for (int i = 0; i < n; ++i) starts.push_back({6.0 * i, 0, 2});
    Fleet fleet(starts);
    for (int number = 0; number < 6; ++number) {
      for (int mav = 1; mav <= n; ++mav) {
        std::vector<Eigen::Vector3d> points;
        for (int i = 0; i < 3; ++i)
          points.push_back({random.uniform(0, 30), random.uniform(0, 30), random.uniform(2, 4)});
        fleet.send(mav, points, number);
      }
      fleet.fly(random.uniform(1, 8));
    }
    EXPECT_GE(fleet.nearest_m, kMin_m) << "run " << run << " with " << n << " MAVs";
  }
}

}  // namespace
}  // namespace comptonaut
