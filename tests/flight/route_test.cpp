// SPDX-License-Identifier: BSD-3-Clause
#include "flight/route.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/random.h"
#include "world/voxels.h"

namespace comptonaut {
namespace {

RouteConfig small_mav() {
  RouteConfig config;
  config.envelope = {.radius_m = 0.4, .half_height_m = 0.6};
  config.separation = {.radius_m = 2.0, .half_height_m = 3.0};
  config.fence = {.border = polygon_of({-1, 21, -1, 21}), .floor_m = 0.5, .ceiling_m = 6.0};
  config.step_m = 0.5;
  return config;
}

/// Free air over flat ground, with boxes in it.
Voxels town(const std::vector<Box>& buildings) {
  Voxels voxels;
  for (int x = -4; x < 46; ++x) {
    for (int y = -4; y < 46; ++y) {
      for (int z = -1; z < 16; ++z) {
        const Eigen::Vector3d p_W = voxels.centre_W({x, y, z});
        const Box here{p_W, p_W};
        const bool wall =
            std::any_of(buildings.begin(), buildings.end(), [&](const Box& b) { return b.touches(here); });
        voxels.known[{x, y, z}] = wall || z < 0 ? Occupancy::kOccupied : Occupancy::kFree;
      }
    }
  }
  return voxels;
}

/// By dense sampling of the envelope's centre line against every closed voxel.
bool collides(const World& world, const Envelope& envelope, const std::vector<Eigen::Vector3d>& route) {
  const Eigen::Vector3d axes(envelope.radius_m, envelope.radius_m, envelope.half_height_m);
  for (std::size_t i = 1; i < route.size(); ++i) {
    for (int k = 0; k <= 200; ++k) {
      const Eigen::Vector3d p_W = route[i - 1] + k / 200.0 * (route[i] - route[i - 1]);
      const bool hit = world.any_closed({p_W - axes, p_W + axes}, [&](const Box& box) {
        return (p_W.cwiseMax(box.min_W).cwiseMin(box.max_W) - p_W).cwiseQuotient(axes).norm() < 1.0;
      });
      if (hit) return true;
    }
  }
  return false;
}

double nearest_m(const std::vector<Eigen::Vector3d>& route, const Leg& other) {
  double nearest = 1e9;
  for (std::size_t i = 1; i < route.size(); ++i) {
    for (int k = 0; k <= 100; ++k) {
      for (int l = 0; l <= 100; ++l) {
        const Eigen::Vector3d a = route[i - 1] + k / 100.0 * (route[i] - route[i - 1]);
        const Eigen::Vector3d b = other.from_W + l / 100.0 * (other.to_W - other.from_W);
        nearest = std::min(nearest, (a - b).norm());
      }
    }
  }
  return nearest;
}

TEST(Route, IsTheStraightLineWhereThatIsClear) {
  const auto route = find_route(World::flat(), small_mav(), {0, 0, 2}, {20, 15, 3});
  ASSERT_TRUE(route);
  EXPECT_EQ(*route, (std::vector<Eigen::Vector3d>{{0, 0, 2}, {20, 15, 3}}));
}

TEST(Route, GoesAroundHousesWithoutTouchingThem) {
  Random random(1);
  int around = 0;
  for (int run = 0; run < 12; ++run) {
    std::vector<Box> buildings;
    for (int i = 0; i < 6; ++i) {
      const Eigen::Vector3d corner(random.uniform(2, 15), random.uniform(2, 15), 0);
      buildings.push_back({corner, corner + Eigen::Vector3d(random.uniform(1, 5), random.uniform(1, 5), 7)});
    }
    const World world = world_of(town(buildings), "houses.bt");
    const RouteConfig config = small_mav();
    const auto route = find_route(world, config, {0, 0, 2}, {20, 20, 2});
    ASSERT_TRUE(route) << "run " << run;
    EXPECT_EQ(route->front(), Eigen::Vector3d(0, 0, 2));
    EXPECT_EQ(route->back(), Eigen::Vector3d(20, 20, 2));
    EXPECT_FALSE(collides(world, config.envelope, *route)) << "run " << run;
    for (const Eigen::Vector3d& p_W : *route) EXPECT_TRUE(config.fence.contains(p_W)) << "run " << run;
    around += route->size() > 2;
  }
  EXPECT_GT(around, 6);
}

TEST(Route, FliesOverAWallThatItCannotFlyAround) {
  const World world = world_of(town({{{8, -9, 0}, {9, 30, 4}}}), "wall.bt");
  const RouteConfig config = small_mav();
  const auto route = find_route(world, config, {0, 10, 2}, {20, 10, 2});
  ASSERT_TRUE(route);
  EXPECT_FALSE(collides(world, config.envelope, *route));
  EXPECT_LT(route->size(), 7u) << "not shortened";
}

TEST(Route, LeadsRoundALongWallInFewSteps) {
  const World world = world_of(town({{{8, 0, 0}, {9, 30, 9}}}), "long_wall.bt");
  RouteConfig config = small_mav();
  config.step_m = 0.25;
  config.expanded_max = 1500;
  const auto route = find_route(world, config, {0, 18, 2}, {17, 18, 2});
  ASSERT_TRUE(route);
  EXPECT_FALSE(collides(world, config.envelope, *route));
  double way_m = 0.0;
  for (std::size_t i = 1; i < route->size(); ++i) way_m += ((*route)[i] - (*route)[i - 1]).norm();
  const double corner_m = std::hypot(8.0, 18.4) + 1.8 + std::hypot(8.0, 18.4);
  EXPECT_LT(way_m, 1.1 * corner_m);
}

TEST(Route, LeadsThroughAGapThatTheWideGridMisses) {
  const World world = world_of(town({{{8, -9, 0}, {9, 11.9, 9}}, {{8, 13.6, 0}, {9, 30, 9}}}), "gap.bt");
  const RouteConfig config = small_mav();
  const auto route = find_route(world, config, {0, 18, 2}, {20, 18, 2});
  ASSERT_TRUE(route);
  EXPECT_FALSE(collides(world, config.envelope, *route));
}

TEST(Route, IsNoneWhereThereIsNoWay) {
  const World walled = world_of(town({{{8, -9, 0}, {9, 30, 9}}}), "high_wall.bt");
  const RouteConfig config = small_mav();
  EXPECT_FALSE(find_route(walled, config, {0, 10, 2}, {20, 10, 2})) << "wall up to the ceiling";
  EXPECT_FALSE(find_route(walled, config, {0, 10, 2}, {8.5, 10, 2})) << "goal inside the wall";
  EXPECT_FALSE(find_route(walled, config, {8.5, 10, 2}, {0, 10, 2})) << "start inside the wall";
  EXPECT_FALSE(find_route(World::flat(), config, {0, 0, 2}, {30, 0, 2})) << "goal outside the fence";
  EXPECT_FALSE(find_route(World::flat(), config, {0, 0, 2}, {10, 0, 0.55})) << "goal too low";
}

TEST(Route, GetsAwayFromAnObstacleThatIsTooNearButNotAlongIt) {
  const World walled = world_of(town({{{8, -9, 0}, {9, 30, 9}}}), "near_wall.bt");
  RouteConfig config = small_mav();
  const Eigen::Vector3d start_W(7.9, 10, 2), goal_W(4, 20, 2);
  const auto route = find_route(walled, config, start_W, goal_W);
  ASSERT_TRUE(route);
  for (std::size_t i = 1; i < route->size(); ++i) {
    EXPECT_FALSE(meets_closed(walled, config.envelope, {(*route)[i], (*route)[i]})) << i;
    EXPECT_TRUE(i == 1 || !meets_closed(walled, config.envelope, {(*route)[i - 1], (*route)[i]})) << i;
  }
  EXPECT_LT(((*route)[1] - start_W).norm(), 2.0 * config.step_m) << "away first";
}

TEST(Route, KeepsAMarginBesidesItsEnvelope) {
  const World walled = world_of(town({{{8, -9, 0}, {9, 30, 9}}}), "margin_wall.bt");
  RouteConfig config = small_mav();
  const double beside_m = 8.0 - config.envelope.radius_m - 0.1;
  EXPECT_TRUE(find_route(walled, config, {0, 10, 2}, {beside_m, 10, 2}));
  config.margin_m = 0.4;
  EXPECT_FALSE(find_route(walled, config, {0, 10, 2}, {beside_m, 10, 2}));
  EXPECT_TRUE(find_route(walled, config, {0, 10, 2}, {beside_m - 0.4, 10, 2}));
}

TEST(Route, LeavesUnknownSpaceAloneUnlessItIsDeclaredFree) {
  Voxels voxels = town({});
  for (int y = -4; y < 46; ++y) {
    for (int z = 0; z < 16; ++z) voxels.known.erase({20, y, z});
  }
  const RouteConfig config = small_mav();
  EXPECT_FALSE(find_route(world_of(voxels, "unknown.bt"), config, {0, 10, 2}, {20, 10, 2}));
  EXPECT_TRUE(find_route(world_of(voxels, "unknown.bt", UnknownSpace::kFree), config, {0, 10, 2}, {20, 10, 2}));
}

TEST(Route, KeepsItsDistanceFromLegsThatOthersHaveTaken) {
  RouteConfig config = small_mav();
  config.separation = {.radius_m = 2.0, .half_height_m = 2.0};
  const std::vector<Leg> taken{{{10, -1, 2}, {10, 12, 2}}, {{4, 18, 2}, {4, 18, 2}}};
  const auto route = find_route(World::flat(), config, {0, 5, 2}, {20, 5, 2}, taken);
  ASSERT_TRUE(route);
  for (const Leg& other : taken) EXPECT_GE(nearest_m(*route, other), 2.0 - 1e-6);
  EXPECT_FALSE(find_route(World::flat(), config, {0, 5, 2}, {10, 5, 2}, taken)) << "goal on a taken leg";
}

TEST(Route, LetsAMavOutOfAnothersWayButNotNearerToIt) {
  RouteConfig config = small_mav();
  const std::vector<Leg> taken{{{10, 0, 2}, {10, 20, 2}}};
  const auto away = find_route(World::flat(), config, {11, 5, 2}, {18, 5, 2}, taken);
  ASSERT_TRUE(away);
  EXPECT_GE(nearest_m(*away, taken[0]), 0.98);
  EXPECT_FALSE(find_route(World::flat(), config, {11, 5, 2}, {10.2, 5, 2}, taken));
}

TEST(Route, LetsAMavOutThatStandsOnAnothersWay) {
  RouteConfig config = small_mav();
  const std::vector<Leg> taken{{{0, 5, 2}, {14, 5, 2}}};
  for (const double beside_m : {0.0, 1e-4, 1e-3, 0.02, 0.1, 0.5}) {
    const auto out = find_route(World::flat(), config, {8, 5 - beside_m, 2}, {20, 5, 2}, taken);
    ASSERT_TRUE(out) << beside_m << " m beside the leg";
    EXPECT_GE(nearest_m({(*out)[1], out->back()}, taken[0]), 1.0) << beside_m << " m beside the leg";
  }
}

TEST(Route, ComesBackFromOutsideTheFence) {
  const RouteConfig config = small_mav();
  EXPECT_TRUE(find_route(World::flat(), config, {-5, 10, 2}, {5, 10, 2}));
  EXPECT_FALSE(find_route(World::flat(), config, {5, 10, 2}, {-5, 10, 2}));
}

}  // namespace
}  // namespace comptonaut
