// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "nodes/dispatch_fixture.h"
#include "start_time.h"
#include "world/world.h"

namespace comptonaut {
namespace {

TEST(Dispatch, WithoutAnyMavThereIsNothingToPlan) { EXPECT_TRUE(Team{.config = zigzag()}.tick().empty()); }

TEST(Dispatch, OneMavAloneFliesWithStampedWaypoints) {
  Team team{.config = zigzag()};
  team.places_W = {{2, {1, 1, 2}}};
  const auto plans = team.tick();
  ASSERT_EQ(plans.size(), 1u);
  EXPECT_EQ(plans[0].status, "searching");
  ASSERT_FALSE(plans[0].waypoints.empty());
  Utime before = team.utime;
  for (const Waypoint& waypoint : plans[0].waypoints) {
    EXPECT_GT(waypoint.utime, before);
    before = waypoint.utime;
  }
}

TEST(Dispatch, TheOthersTakeOverFromOneThatIsLost) {
  Team team{.config = zigzag()};
  team.places_W = {{1, {1, 1, 2}}, {2, {30, 1, 2}}};
  const double strip_m = team.tick()[0].waypoints.back().p_W.x();
  team.places_W.erase(2);
  const auto plans = team.ticks(6);
  ASSERT_EQ(plans.size(), 2u);
  EXPECT_EQ(plans[1].status, "lost: no position for 6 s");
  EXPECT_TRUE(plans[1].waypoints.empty());
  EXPECT_NE(plans[0].status.substr(0, 4), "lost");
  EXPECT_LT(strip_m, 26.0);
}

TEST(Dispatch, SaysOfEachThatAllAreLost) {
  Team team{.config = zigzag()};
  team.places_W = {{1, {1, 1, 2}}, {2, {30, 1, 2}}};
  team.tick();
  team.places_W.clear();
  for (const Plan& plan : team.ticks(8)) {
    EXPECT_EQ(plan.status, "lost: no position for 8 s");
    EXPECT_TRUE(plan.waypoints.empty());
  }
}

TEST(Dispatch, AMavInsideAnObstacleHoldsAndSaysWhy) {
  Team team{.config = zigzag()};
  team.places_W = {{1, {1, 1, -0.2}}};
  const Plan plan = team.tick().front();
  EXPECT_TRUE(plan.waypoints.empty());
  EXPECT_NE(plan.status.find("the MAV is at an obstacle or in unknown space"), std::string::npos) << plan.status;
}

TEST(Dispatch, AMavTooNearToAnObstacleGetsAwayFromIt) {
  Team team{.config = zigzag()};
  team.places_W = {{1, {1, 1, 0.2}}};  // on the ground, below the envelope's half height
  team.fly = true;
  EXPECT_EQ(team.tick().front().status, "searching");
  EXPECT_GT(team.places_W[1].z(), 1.0);
}

/// The words of a plan from `start_W` to the middle of `look`, in the world that `at` tells.
std::string said_of(const Eigen::Vector3d& start_W, const Area& look,
                    const std::function<Occupancy(const Eigen::Vector3d&)>& at) {
  CoordinatorConfig config = zigzag();
  config.area = {0, 20, 0, 20};
  config.search.look_first = {look};
  config.search.route.expanded_max = 20'000;
  config.search.route.fence.border = polygon_of(config.area, 0.0);
  Team team{.config = config, .world = World::of_voxels({{-2, -2, -1}, {22, 22, 8}}, 0.5, at)};
  team.cells = team.world.surface_cells(config.area, 1.0);
  team.zeros.assign(team.cells.size(), 0.0);
  team.places_W = {{1, start_W}};
  const Plan plan = team.tick().front();
  EXPECT_TRUE(plan.waypoints.empty()) << plan.status;
  return plan.status;
}

TEST(Dispatch, AGoalThatIsWalledInIsTold) {
  const std::string status = said_of({3, 3, 3}, {9, 11, 9, 11}, [](const Eigen::Vector3d& p_W) {
    const double away_m = (p_W.head<2>() - Eigen::Vector2d(10, 10)).cwiseAbs().maxCoeff();
    return p_W.z() < 0 || (away_m > 5 && away_m < 6) ? Occupancy::kOccupied : Occupancy::kFree;
  });
  EXPECT_NE(status.find("it is walled in"), std::string::npos) << status;
}

TEST(Dispatch, AMavInAHoleOfTheMapHoldsAndSaysWhy) {
  const std::string status = said_of({10, 10, 3}, {2, 4, 2, 4}, [](const Eigen::Vector3d& p_W) {
    const double away_m = (p_W.head<2>() - Eigen::Vector2d(10, 10)).cwiseAbs().maxCoeff();
    if (away_m < 2.5) return Occupancy::kUnknown;
    return p_W.z() < 0 ? Occupancy::kOccupied : Occupancy::kFree;
  });
  EXPECT_NE(status.find("the MAV is at an obstacle or in unknown space"), std::string::npos) << status;
}

TEST(Dispatch, AFenceThatExcludesTheGroundIsTold) {
  CoordinatorConfig config = zigzag();
  config.search.route.fence.border = polygon_of({-30, -10, 0, 20});
  Team team{.config = config};
  team.places_W = {{1, {-20, 5, 2}}};
  const Plan plan = team.tick().front();
  EXPECT_TRUE(plan.waypoints.empty());
  EXPECT_NE(plan.status.find("it is outside the fence"), std::string::npos) << plan.status;
}

TEST(Dispatch, StartsThatOverlapAreToldAndComeApart) {
  Team team{.config = zigzag()};
  team.places_W = {{1, {10, 10, 2}}, {2, {11, 10, 2}}, {3, {10, 11, 2}}, {4, {40, 10, 2}}};
  team.fly = true;
  const auto told = [](const Plan& plan) { return plan.status.find("; too near to MAV ") != std::string::npos; };
  const std::vector<Plan> first = team.tick();
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(told(first[i])) << first[i].status;
  EXPECT_EQ(first[1].status, "searching; too near to MAV 1: getting away");
  EXPECT_EQ(first[3].status, "searching");
  for (const Plan& plan : team.ticks(20)) EXPECT_FALSE(told(plan)) << plan.status;
  for (const auto& [a, p_W] : team.places_W) {
    for (const auto& [b, q_W] : team.places_W) EXPECT_TRUE(a == b || (p_W - q_W).norm() >= 2.2) << a << " and " << b;
  }
}

TEST(Dispatch, KeepsOutOfTheReachOfAStrongSource) {
  CoordinatorConfig config = zigzag();
  config.search.keep_out = {.activity_min_Bq = 1e9, .radius_m = 6.0};
  Team team{.config = config};
  team.sources = {{.p_W = {25, 25, 0}, .activity_Bq = 4e9}};
  team.places_W = {{1, {1, 1, 2}}};
  team.fly = true;
  for (int i = 0; i < 60; ++i) {
    team.tick();
    EXPECT_GE((team.places_W[1].head<2>() - Eigen::Vector2d(25, 25)).norm(), 6.0 - 1e-6) << "tick " << i;
  }
}

TEST(Dispatch, OneThatIsLostForLongIsNotToldToHoldAnyMore) {
  Team team{.config = zigzag()};
  team.places_W = {{1, {1, 1, 2}}, {2, {30, 1, 2}}};
  team.tick();
  team.places_W.erase(2);
  EXPECT_EQ(team.ticks(29).size(), 2u);
  EXPECT_EQ(team.ticks(2).size(), 1u) << "without plans it returns on its own";
}

TEST(Dispatch, OneWhoseDetectorIsDeadFliesHomeUntilItMeasuresAgain) {
  Team team{.config = zigzag()};
  team.places_W = {{1, {1, 1, 2}}};
  team.fly = true;
  team.ticks(5);
  team.alive = false;
  EXPECT_EQ(team.ticks(9).front().status, "searching");
  const std::string status = team.ticks(2).front().status;
  EXPECT_TRUE(status.starts_with("its detector measures nothing: ")) << status;
  EXPECT_EQ(team.ticks(9).front().status, "its detector measures nothing: at home");
  EXPECT_NEAR((team.places_W[1] - Eigen::Vector3d(1, 1, 2)).norm(), 0.0, 1.0);
  team.alive = true;
  EXPECT_EQ(team.tick().front().status, "searching");
}

CoordinatorConfig information() {
  CoordinatorConfig config = zigzag();
  config.search.strategy = "information";
  return config;
}

TEST(Dispatch, TheInformationSearchIsNotOverWhereNobodyMayFly) {
  CoordinatorConfig config = information();
  config.search.route.fence.border = polygon_of({-30, -10, 0, 20});
  Team team{.config = config};
  team.places_W = {{1, {-20, 5, 2}}};
  const Plan plan = team.tick().front();
  EXPECT_TRUE(plan.waypoints.empty());
  EXPECT_EQ(plan.status, "nobody may fly above any of the ground");
}

TEST(Dispatch, TheInformationSearchDoesNotWaitBeforeAWalledInYard) {
  CoordinatorConfig config = information();
  config.area = {0, 40, 0, 40};
  config.search.route.fence.border = polygon_of(config.area, 0.0);
  const auto yard = [](const Eigen::Vector3d& p_W) {
    const double away_m = (p_W.head<2>() - Eigen::Vector2d(20, 20)).cwiseAbs().maxCoeff();
    return p_W.z() < 0 || (away_m > 7 && away_m < 8) ? Occupancy::kOccupied : Occupancy::kFree;
  };
  Team team{.config = config, .world = World::of_voxels({{-2, -2, -1}, {42, 42, 5}}, 0.5, yard)};
  team.cells = team.world.surface_cells(config.area, 1.0);
  team.zeros.assign(team.cells.size(), 0.0);
  team.places_W = {{1, {3, 3, 3}}};
  team.fly = true;
  int holds = 0;
  for (int i = 0; i < 40; ++i) holds += team.tick().front().waypoints.empty() ? 1 : 0;
  EXPECT_LT(holds, 12);
}

TEST(Dispatch, OneWhoseHomeIsTooNearToAStrongSourceGoesAsNearAsItMay) {
  CoordinatorConfig config = zigzag();
  config.search.keep_out = {.activity_min_Bq = 1e9, .radius_m = 6.0};
  config.endurance_s = 40.0;
  Team team{.config = config};
  team.places_W = {{1, {10, 10, 2}}};
  team.fly = true;
  team.ticks(3);
  team.sources = {{.p_W = {10, 12, 0}, .activity_Bq = 4e9}};
  const std::string status = team.ticks(30).front().status;
  EXPECT_EQ(status, "battery: at home");
  EXPECT_LT((team.places_W[1].head<2>() - Eigen::Vector2d(10, 12)).norm(), 7.5);
}

}  // namespace
}  // namespace comptonaut
