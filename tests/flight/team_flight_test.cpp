// SPDX-License-Identifier: BSD-3-Clause
#include "flight/team_flight.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "flight/fleet.h"
#include "world/voxels.h"

namespace comptonaut {
namespace {

/// Free air with pillars, 40 x 40 x 12 m.
World pillars(std::uint64_t seed) {
  Voxels voxels{.voxel_m = 1.0};
  Random random(seed);
  std::vector<Eigen::Vector2i> corners;
  for (int i = 0; i < 8; ++i)
    corners.emplace_back(3 + static_cast<int>(random() % 32), 3 + static_cast<int>(random() % 22));
  for (int x = -2; x < 42; ++x) {
    for (int y = -2; y < 42; ++y) {
      for (int z = -1; z < 12; ++z) {
        const bool in = std::any_of(corners.begin(), corners.end(), [&](const Eigen::Vector2i& c) {
          return x >= c.x() && x < c.x() + 3 && y >= c.y() && y < c.y() + 3;
        });
        voxels.known[{x, y, z}] = in || z < 0 ? Occupancy::kOccupied : Occupancy::kFree;
      }
    }
  }
  return world_of(voxels, "pillars" + std::to_string(seed) + ".bt");
}

TEST(TeamFlight, TenThousandRandomFleetsKeepTheirSeparationTheFenceAndClearOfObstacles) {
  constexpr int kFleetsPerWorld = 10;
  Random random(1);
  double flown_m = 0.0, nearest = 1e9;
  int ticks = 0;
  World world = World::flat();
  for (int run = 0; run < 10'000; ++run) {
    if (run % kFleetsPerWorld == 0) {
      const int number = run / kFleetsPerWorld;
      world = number % 5 == 0 ? World::flat() : pillars(static_cast<std::uint64_t>(number));
    }
    Fleet fleet{.world = world, .route = small_field(), .config = {.horizon_s = random.uniform(3, 9)}};
    add_somewhere(fleet, random, 2 + static_cast<int>(random() % 4));
    for (int tick = 0; tick < 3; ++tick, ++ticks) {
      draw_courses(fleet, random);
      const auto before = fleet.mavs;
      (void)fleet.tick(1.0, [&](const Fleet& now) {
        nearest = std::min(nearest, now.nearest());
        ASSERT_GE(now.nearest(), 1.0) << "run " << run << " tick " << tick;
        for (const Fleet::Mav& mav : now.mavs) {
          ASSERT_TRUE(now.route.fence.contains(mav.flyer.now.p_W) || mav.flyer.now.p_W.z() < 1.0 + 1e-6)
              << "run " << run << " tick " << tick << " at " << mav.flyer.now.p_W.transpose();
          ASSERT_FALSE(now.touches_closed(mav)) << "run " << run << " tick " << tick;
        }
      });
      if (HasFatalFailure()) return;
      for (std::size_t i = 0; i < before.size(); ++i)
        flown_m += (before[i].flyer.now.p_W - fleet.mavs[i].flyer.now.p_W).norm();
    }
  }
  EXPECT_GT(flown_m / ticks, 3.0) << "they hardly fly: the test tests nothing";
  EXPECT_LT(nearest, 1.2) << "nobody ever came near another";
  RecordProperty("flown_m_per_tick", std::to_string(flown_m / ticks));
}

/// What it flies until a plan arrives, and so from where and how fast it turns, is not what the plan was made for.
TEST(TeamFlight, PlansThatComeLateKeepMavsClearOfObstacles) {
  std::vector<World> worlds;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) worlds.push_back(pillars(seed));
  const Envelope body{.radius_m = 0.3, .half_height_m = 0.3};
  Random random(2);
  int hits = 0;
  for (int run = 0; run < 2'000; ++run) {
    Fleet fleet{.world = worlds[random() % worlds.size()], .route = small_field(), .late_s = 0.1};
    add_somewhere(fleet, random, 1);
    for (int tick = 0; tick < 6; ++tick) {
      draw_courses(fleet, random);
      bool hit = false;
      (void)fleet.tick(1.0, [&](const Fleet& now) {
        for (const Fleet::Mav& mav : now.mavs) hit = hit || now.touches_closed(mav, body);
      });
      hits += hit ? 1 : 0;
    }
  }
  EXPECT_EQ(hits, 0);
}

/// Flies at full speed along y = 15, when `change` happens 14 m ahead; it needs 9 m to stop. How far it gets, m.
double flown_m(const World& before, const World& after, const Fence& fence_after) {
  RouteConfig route = small_field();
  const TeamFlightConfig config;
  TeamFlight team(config);
  Flyer flyer{.mav = 1, .now = {.p_W = {2, 15, 4}, .v_W = {8, 0, 0}}, .course_W = {{38, 15, 4}}};
  const auto told = team.plan(before, route, std::span(&flyer, 1), kStart)[0].waypoints;
  EXPECT_NEAR(told.back().p_W.x(), 38, 1e-6);
  route.fence = fence_after;
  flyer.now = Trajectory(flyer.now.p_W, flyer.now.v_W, told, config.limits).sample(0.5);
  const auto anew = team.plan(after, route, std::span(&flyer, 1), kStart + kSecond_us / 2)[0];
  EXPECT_NE(anew.status, "");
  return Trajectory(flyer.now.p_W, flyer.now.v_W, anew.waypoints, config.limits).sample(60).p_W.x();
}

TEST(TeamFlight, StopsBeforeWhatAppearsInItsWay) {
  Voxels voxels{.voxel_m = 1.0};
  for (int x = -2; x < 42; ++x) {
    for (int y = -2; y < 42; ++y) {
      for (int z = -1; z < 12; ++z) voxels.known[{x, y, z}] = z < 0 ? Occupancy::kOccupied : Occupancy::kFree;
    }
  }
  const World open = world_of(voxels, "open.bt");
  for (int y = -2; y < 42; ++y) {
    for (int z = 0; z < 12; ++z) voxels.known[{20, y, z}] = Occupancy::kOccupied;
  }
  const World walled = world_of(voxels, "walled.bt");
  const Fence fence = small_field().fence;
  EXPECT_LE(flown_m(open, walled, fence), 19.5) << "the wall begins at 20 m";
  Fence smaller = fence;
  smaller.keep_out.push_back({{25, 15}, 5.0});
  EXPECT_LE(flown_m(World::flat(), World::flat(), smaller), 20.0) << "as does the disc";
}

/// Those that are nearer to another one than the separation.
std::vector<bool> too_near(const Fleet& fleet) {
  std::vector<bool> result(fleet.mavs.size(), false);
  for (std::size_t i = 0; i < result.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const auto &a = fleet.mavs[i].flyer.now, &b = fleet.mavs[j].flyer.now;
      if (separations(fleet.route.separation, a.p_W, b.p_W) < 1.0) result[i] = result[j] = true;
    }
  }
  return result;
}

TEST(TeamFlight, StartsThatOverlapAreToldAndDoNotGetNearer) {
  const World world = World::flat();
  Random random(2);
  int told = 0;
  for (int run = 0; run < 500; ++run) {
    Fleet fleet{.world = world, .route = small_field(), .config = {}};
    for (int i = 0; i < 3; ++i) fleet.add({15 + random.uniform(0, 3), 15 + random.uniform(0, 3), 4});
    const double at_start = std::min(1.0, fleet.nearest());
    for (int tick = 0; tick < 5; ++tick) {
      draw_courses(fleet, random);
      const std::vector<bool> near = too_near(fleet);
      const auto flights =
          fleet.tick(1.0, [&](const Fleet& now) { ASSERT_GE(now.nearest(), at_start - 0.02) << "run " << run; });
      if (HasFatalFailure()) return;
      for (std::size_t i = 0; i < near.size(); ++i) {
        EXPECT_EQ(flights[i].status.starts_with("too near to MAV "), near[i]) << "run " << run << " tick " << tick;
        told += near[i] ? 1 : 0;
      }
    }
  }
  EXPECT_GT(told, 500);
}

TEST(TeamFlight, TheFirstHasPriorityAndTheSecondWaitsAndThenGoes) {
  const World world = World::flat();
  Fleet fleet{.world = world, .route = small_field(), .config = {}};
  fleet.add({2, 15, 4});
  fleet.add({15, 2, 4});
  fleet.mavs[0].flyer.course_W = {{30, 15, 4}};
  fleet.mavs[1].flyer.course_W = {{15, 28, 4}};
  const auto nothing = [](const Fleet& now) { ASSERT_GE(now.nearest(), 1.0); };
  const auto flights = fleet.tick(1.0, nothing);
  EXPECT_EQ(flights[0].status, "");
  EXPECT_EQ(flights[0].waypoints.back().p_W, Eigen::Vector3d(30, 15, 4));
  EXPECT_EQ(flights[1].status, "waiting for MAV 1");
  for (int tick = 0; tick < 15; ++tick) (void)fleet.tick(1.0, nothing);
  EXPECT_LT((fleet.mavs[1].flyer.now.p_W - Eigen::Vector3d(15, 28, 4)).norm(), 0.1);
}

TEST(TeamFlight, StampsEachWaypointWithTheTimeWhenItIsReached) {
  const World world = World::flat();
  Fleet fleet{.world = world, .route = small_field(), .config = {.horizon_s = 60}};
  fleet.add({2, 2, 4});
  fleet.mavs[0].flyer.course_W = {{12, 2, 4}, {12, 22, 4}, {30, 22, 4}};
  const auto flights = fleet.plan();
  const Trajectory trajectory({2, 2, 4}, {0, 0, 0}, flights[0].waypoints, fleet.config.limits);
  ASSERT_EQ(flights[0].waypoints.size(), 3u);
  for (const Waypoint& waypoint : flights[0].waypoints) {
    const Motion there = trajectory.sample(seconds(waypoint.utime - fleet.utime));
    EXPECT_LE((there.p_W - waypoint.p_W).norm(), fleet.config.limits.corner_deviation_max_m + 1e-6);
  }
  EXPECT_NEAR(seconds(flights[0].waypoints.back().utime - fleet.utime), trajectory.duration_s(), 1e-5);
}

}  // namespace
}  // namespace comptonaut
