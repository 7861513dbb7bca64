// SPDX-License-Identifier: BSD-3-Clause
// When MAVs are sent home, and on which ways.
#include <gtest/gtest.h>

#include "nodes/dispatch_fixture.h"
#include "nodes/separation.h"

namespace comptonaut {
namespace {

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

TEST(Dispatch, SendsAMavHomeBeforeItsBatteryIsDownToTheReserve) {
  CoordinatorConfig config = zigzag();
  config.battery_reserve_percent = 20.0;
  const auto searched_s = [&](double full_percent, double used_percent_s) {
    Team team{.config = config, .battery_percent = full_percent, .used_percent_s = used_percent_s};
    team.places_W = {{1, {1, 1, 2}}};
    team.tick();
    team.places_W[1] = {40, 40, 2};
    int n = 0;
    while (n < 200 && team.tick()[0].status.starts_with("searching")) ++n;
    return n;
  };
  EXPECT_NEAR(searched_s(100.0, 1.0), 80 - 16, 2) << "the way home takes 16 s";
  EXPECT_NEAR(searched_s(60.0, 0.5), 80 - 16, 2) << "not all begin full";
  EXPECT_EQ(searched_s(21.0, 1.0), 0) << "down to it before the first percentages tell how quickly it falls";
  EXPECT_EQ(searched_s(50.0, 0.0), 200);
  EXPECT_EQ(searched_s(std::numeric_limits<double>::quiet_NaN(), 0.0), 200) << "not told";
  config.battery_reserve_percent = 0.0;
  EXPECT_EQ(searched_s(50.0, 0.2), 200) << "not watched";
}

TEST(Dispatch, LetsAMavWithANewBatterySearchOn) {
  CoordinatorConfig config = zigzag();
  config.endurance_s = 200.0;
  Team team{.config = config, .fly = true, .battery_percent = 22.0, .used_percent_s = 0.5};
  team.places_W = {{1, {1, 1, 2}}};
  EXPECT_EQ(team.ticks(10).front().status, "battery: at home");
  team.battery_percent += 20.0;  // it rests
  EXPECT_EQ(team.ticks(2).front().status, "battery: at home");
  team.battery_percent = 100.0;
  EXPECT_EQ(team.ticks(2).front().status, "searching");
  team.fly = false;
  EXPECT_EQ(team.ticks(130).front().status, "searching") << "its clock starts again, too";
  EXPECT_TRUE(team.ticks(40).front().status.starts_with("battery: "));
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

}  // namespace
}  // namespace comptonaut
