// SPDX-License-Identifier: BSD-3-Clause
// MAVs that do not fly as they are told: lost, dropped out, or slower.
#include <gtest/gtest.h>

#include "core/random.h"
#include "flight/fleet.h"
#include "world/voxels.h"

namespace comptonaut {
namespace {

/// Whether all could brake now without coming too near to each other.
bool all_can_brake(const Fleet& fleet) {
  std::vector<Slots> slots;
  for (const Fleet::Mav& mav : fleet.mavs) {
    const Trajectory brake(mav.flyer.now.p_W, mav.flyer.now.v_W, {}, fleet.config.limits);
    slots.push_back(slots_of(brake, 0.0, fleet.config.slot_s, fleet.config.limits.acceleration_max_m_s2));
  }
  for (std::size_t j = 0; j < slots.size(); ++j) {
    for (std::size_t i = 0; i < j; ++i) {
      if (!keep_apart(fleet.route.separation, slots[i], slots[j])) return false;
    }
  }
  return fleet.nearest() >= 1.0;
}

TEST(TeamFlight, OneThatDropsOutIsFlownAroundByAllThatCanStillBrake) {
  const World world = World::flat();
  Random random(3);
  int runs = 0;
  for (int run = 0; run < 1000; ++run) {
    Fleet fleet{.world = world, .route = small_field(), .config = {}};
    add_somewhere(fleet, random, 4);
    bool can_brake = false;
    for (int tick = 0; tick < 7; ++tick) {
      draw_courses(fleet, random);
      if (tick == 2) fleet.mavs[random() % fleet.mavs.size()].out = true;
      if (tick == 3) can_brake = all_can_brake(fleet);  // now its standing still is seen
      (void)fleet.tick(1.0, [&](const Fleet& now) {
        ASSERT_TRUE(!can_brake || now.nearest() >= 1.0) << "run " << run << " tick " << tick;
      });
      if (HasFatalFailure()) return;
    }
    runs += can_brake ? 1 : 0;
  }
  EXPECT_GT(runs, 500);
}

/// A flight is checked to be early or late by slot_s; a tenth slower costs half of that in a second.
TEST(TeamFlight, EverySecondOneATenthSlowerThanPlannedKeepsItsSeparation) {
  const World world = World::flat();
  Random random(4);
  for (int run = 0; run < 1000; ++run) {
    Fleet fleet{.world = world, .route = small_field(), .config = {}};
    add_somewhere(fleet, random, 4);
    for (Fleet::Mav& mav : fleet.mavs) mav.pace = mav.flyer.mav % 2 == 0 ? 0.9 : 1.0;
    for (int tick = 0; tick < 8; ++tick) {
      draw_courses(fleet, random);
      (void)fleet.tick(1.0,
                       [&](const Fleet& now) { ASSERT_GE(now.nearest(), 1.0) << "run " << run << " tick " << tick; });
      if (HasFatalFailure()) return;
    }
  }
}

/// The second has nothing new to fly, as its new course leads where nobody may be, and flies what it was told far too
/// slowly: the first would pass where it should long have passed, but is not.
TEST(TeamFlight, OneThatFallsBehindStopsAndTheOthersGetOn) {
  const World world = World::flat();
  Fleet fleet{.world = world, .route = small_field(), .config = {}};
  fleet.route.fence.excluded = {polygon_of({10, 14.7, 0, 12})};
  fleet.add({2, 15, 4});
  fleet.add({15, 2, 4});
  fleet.mavs[1].pace = 0.4;
  fleet.mavs[1].flyer.course_W = {{15, 28, 4}};
  std::vector<Flight> flights;
  for (int tick = 0; tick < 10; ++tick) {
    if (tick == 1) fleet.mavs[1].flyer.course_W = {{12, 10, 4}};
    if (tick == 4) fleet.mavs[0].flyer.course_W = {{30, 15, 4}};
    flights = fleet.tick(1.0, [&](const Fleet& now) { ASSERT_GE(now.nearest(), 1.0) << "tick " << tick; });
    if (HasFatalFailure()) return;
  }
  EXPECT_LT((fleet.mavs[0].flyer.now.p_W - Eigen::Vector3d(30, 15, 4)).norm(), 0.1) << flights[0].status;
  EXPECT_TRUE(flights[1].waypoints.empty());
  fleet.mavs[1].flyer.course_W = {{15, 28, 4}};
  fleet.mavs[1].pace = 1.0;
  for (int tick = 0; tick < 6; ++tick) (void)fleet.tick(1.0, [](const Fleet& now) { ASSERT_GE(now.nearest(), 1.0); });
  EXPECT_LT((fleet.mavs[1].flyer.now.p_W - Eigen::Vector3d(15, 28, 4)).norm(), 0.1);
}

/// Free air of 30 x 10 x 8 m, and in it the end of a wall.
World wall_to_the_south() {
  Voxels voxels;
  for (int x = 0; x < 60; ++x) {
    for (int y = 20; y < 40; ++y) {
      for (int z = 0; z < 16; ++z) {
        const bool wall = (x == 28 || x == 29) && y < 28;  // up to y = 14 m
        voxels.known[{x, y, z}] = wall ? Occupancy::kOccupied : Occupancy::kFree;
      }
    }
  }
  return world_of(voxels, "end_of_a_wall.bt");
}

TEST(TeamFlight, OneThatGaveWayBrakesWhereItsFlightWouldLeadItIntoAWall) {
  const World world = wall_to_the_south();
  for (const double aside_m : {0.0, 1.7}) {
    Fleet fleet{.world = world, .route = small_field(), .config = {}};
    fleet.add({4, 15, 4});
    fleet.mavs[0].flyer.course_W = {{27, 15, 4}};
    (void)fleet.tick(1.0, [](const Fleet&) {});
    fleet.mavs[0].flyer.now.p_W.y() -= aside_m;
    fleet.route.fence.excluded = {polygon_of({0, 40, 0, 13.2})};
    fleet.mavs[0].flyer.course_W = {{fleet.mavs[0].flyer.now.p_W.x(), 11, 4}};  // nobody may fly there: it is to go on
    EXPECT_EQ(fleet.plan()[0].waypoints.empty(), aside_m > 0.0) << aside_m << " m beside its flight";
  }
}

TEST(TeamFlight, GivesTheLostNoPlanAndKeepsAwayFromIt) {
  const World world = World::flat();
  Fleet fleet{.world = world, .route = small_field(), .config = {}};
  fleet.add({2, 15, 4});
  fleet.add({15, 15, 4});
  fleet.mavs[0].flyer.course_W = {{30, 15, 4}};
  fleet.mavs[1].flyer.lost = true;
  for (int tick = 0; tick < 6; ++tick) {
    const auto flights = fleet.tick(1.0, [](const Fleet& now) { ASSERT_GE(now.nearest(), 1.0); });
    EXPECT_TRUE(flights[1].waypoints.empty());
    EXPECT_EQ(flights[0].status, "waiting for MAV 2");
  }
  EXPECT_GT(fleet.mavs[0].flyer.now.p_W.x(), 8.0) << "it comes as near as it may";
}

TEST(TeamFlight, AllLostAndNobodyAtAll) {
  const World world = World::flat();
  Fleet fleet{.world = world, .route = small_field(), .config = {}};
  EXPECT_TRUE(fleet.plan().empty());
  fleet.add({2, 15, 4});
  fleet.mavs[0].flyer.lost = true;
  EXPECT_TRUE(fleet.plan()[0].waypoints.empty());
}

}  // namespace
}  // namespace comptonaut
