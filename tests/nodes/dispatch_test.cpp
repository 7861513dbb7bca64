// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/dispatch.h"

#include <gtest/gtest.h>

#include "nodes/separation.h"
#include "start_time.h"
#include "world/world.h"

namespace comptonaut {
namespace {

/// MAVs that hover, or fly to the last waypoint within a second.
struct Team {
  CoordinatorConfig config;
  Dispatch dispatch{config, {}};
  Cells cells = flat_cells(config.area, 1.0);
  World world = World::flat();
  std::vector<double> zeros = std::vector<double>(cells.size(), 0.0);
  std::vector<SourceEstimate> sources = {};
  std::map<std::int32_t, Eigen::Vector3d> places_W;
  Utime utime = kStart_us;
  bool fly = false;

  std::vector<Plan> tick() {
    dispatch.begin_tick();
    utime += kSecond_us;
    for (const auto& [mav, p_W] : places_W) {
      dispatch.see({.key = {.mission = 1, .sender = mav}, .utime = utime - kBatch_us, .live_us = 50'000, .p_WD = p_W});
    }
    std::vector<Plan> plans = dispatch.plans({cells, world, zeros, zeros, sources}, utime, 1);
    for (const Plan& plan : plans) {
      if (fly && !plan.waypoints.empty() && places_W.contains(plan.mav)) places_W[plan.mav] = plan.waypoints.back().p_W;
    }
    return plans;
  }
  std::vector<Plan> ticks(int n) {
    std::vector<Plan> plans;
    for (int i = 0; i < n; ++i) plans = tick();
    return plans;
  }
};

CoordinatorConfig zigzag() {
  CoordinatorConfig config;
  config.search.strategy = "zigzag";
  config.search.route.fence.border = polygon_of(config.area, 10.0);
  return config;
}

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

TEST(Dispatch, SendsAMavHomeInTimeAndSaysSo) {
  CoordinatorConfig config = zigzag();
  config.endurance_s = 60.0;
  config.reserve_s = 20.0;
  Team team{.config = config};
  team.places_W = {{1, {1, 1, 2}}};
  team.tick();
  team.places_W[1] = {40, 40, 2};  // 55 m from home: 16 s with detours, turning, stopping and the wait for a plan
  EXPECT_EQ(team.ticks(22).front().status, "searching");
  EXPECT_EQ(team.ticks(3).front().status, "battery: flying home");
  team.fly = true;
  EXPECT_EQ(team.ticks(5).front().status, "battery: at home");
  EXPECT_LT((team.places_W[1] - Eigen::Vector3d(1, 1, 2)).norm(), 1.0);
  EXPECT_TRUE(team.ticks(2).front().waypoints.empty());
}

TEST(Dispatch, SendsMavsHomeEarlierWhereTheyWaitForEachOther) {
  CoordinatorConfig config = zigzag();
  config.endurance_s = 60.0;
  const auto searched_s = [&](const std::map<std::int32_t, Eigen::Vector3d>& homes_W) {
    Team team{.config = config};
    team.places_W = homes_W;
    team.tick();
    team.places_W[1] = {40, 40, 2};
    int n = 0;
    while (team.tick()[0].status.starts_with("searching")) ++n;
    return n;
  };
  EXPECT_EQ(searched_s({{1, {1, 1, 2}}, {2, {5, 1, 2}}, {3, {9, 1, 2}}}), searched_s({{1, {1, 1, 2}}}) - 5);
  EXPECT_EQ(searched_s({{1, {1, 1, 2}}, {2, {45, 1, 2}}}), searched_s({{1, {1, 1, 2}}}));
}

/// The smallest distance of a plan's way from a place.
double nearest_m(const Eigen::Vector3d& from_W, const Plan& plan, const Eigen::Vector3d& p_W) {
  double nearest = (from_W - p_W).norm();
  Eigen::Vector3d begin_W = from_W;
  for (const Waypoint& waypoint : plan.waypoints) {
    for (int i = 0; i <= 100; ++i) {
      nearest = std::min(nearest, (begin_W + 0.01 * i * (waypoint.p_W - begin_W) - p_W).norm());
    }
    begin_W = waypoint.p_W;
  }
  return nearest;
}

// A MAV that stands before another one goes on only where its way keeps distance_min + give_way_extra + release_extra.
TEST(Dispatch, SendsAMavHomeRoundOneThatHangsInItsWaySoFarThatThePilotGoesOn) {
  CoordinatorConfig config = zigzag();
  config.endurance_s = 10.0;
  config.reserve_s = 5.0;
  Team team{.config = config};
  team.places_W = {{1, {15, 5, 2}}, {2, {1, 5, 2}}};
  team.tick();
  team.places_W[2] = {30, 5, 2};
  const std::vector<Plan> plans = team.ticks(10);
  EXPECT_EQ(plans[0].status, "battery: at home");
  ASSERT_EQ(plans[1].status, "battery: flying home");
  const SeparationConfig pilot;
  EXPECT_GT(nearest_m(team.places_W[2], plans[1], {15, 5, 2}),
            pilot.distance_min_m + pilot.give_way_extra_m + pilot.release_extra_m + 0.1);
  EXPECT_LT((plans[1].waypoints.back().p_W - Eigen::Vector3d(1, 5, 2)).norm(), 1e-9);
}

TEST(Dispatch, SendsAMavHomeBetweenOthersThatHangNearIt) {
  CoordinatorConfig config = zigzag();
  config.endurance_s = 10.0;
  config.reserve_s = 5.0;
  Team team{.config = config};
  team.places_W = {{1, {11.7, 1, 2}}, {2, {18.3, 1, 2}}, {3, {15, 1, 2}}};  // 3.3 m apart
  team.tick();
  team.places_W[3] = {15, 30, 2};
  const std::vector<Plan> plans = team.ticks(10);
  ASSERT_EQ(plans[2].status, "battery: flying home");
  EXPECT_LT((plans[2].waypoints.back().p_W - Eigen::Vector3d(15, 1, 2)).norm(), 1e-9);
  for (const int mav : {1, 2}) {
    EXPECT_GT(nearest_m(team.places_W[3], plans[2], team.places_W[mav]), config.search.route.separation.radius_m);
  }
}

TEST(Dispatch, TellsThatThereIsNoWayHome) {
  CoordinatorConfig config = zigzag();
  config.endurance_s = 10.0;
  config.reserve_s = 5.0;
  config.search.route.fence.border = polygon_of({10, 50, 0, 50});
  Team team{.config = config};
  team.places_W = {{1, {1, 1, 2}}};
  team.tick();
  team.places_W[1] = {20, 20, 2};
  EXPECT_EQ(team.ticks(10).front().status, "battery: no way home: it is outside the fence");
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
  EXPECT_NE(status.find("it is walled in, or farther than"), std::string::npos) << status;
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

TEST(Dispatch, StartsThatOverlapComeApart) {
  CoordinatorConfig config = zigzag();
  Team team{.config = config};
  team.places_W = {{1, {10, 10, 2}}, {2, {11, 10, 2}}, {3, {10, 11, 2}}};
  team.fly = true;
  team.ticks(20);
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

}  // namespace
}  // namespace comptonaut
