// SPDX-License-Identifier: BSD-3-Clause
#include "search/hover_places.h"

#include <gtest/gtest.h>

#include "core/random.h"

namespace comptonaut {
namespace {

/// 30 x 30 m with a house beside which an alley of 2 m is left, and some huts.
World town(std::uint64_t seed) {
  Random random(seed);
  std::vector<Box> boxes{{{20, 5, 0}, {28, 25, 6}}};
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d corner_W(random.uniform(0, 15), random.uniform(0, 25), 0);
    boxes.push_back({corner_W, corner_W + Eigen::Vector3d(random.uniform(1, 4), random.uniform(1, 4), 3)});
  }
  return World::of_boxes(boxes, {{-5, -5, -1}, {35, 35, 12}}, 0.5);
}

TEST(HoverPlaces, AreAboveTheirSquaresWhereAMavMayHover) {
  const RouteConfig route{.fence = {.border = polygon_of({-1, 31, -1, 31}), .floor_m = 0.5, .ceiling_m = 11}};
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const World world = town(seed);
    const CoarseGround ground(world.surface_cells({0, 30, 0, 30}, 0.5), 2.5, 800);
    const HoverPlaces places = hover_places(ground, world, route, 2.0);
    ASSERT_EQ(places.size(), ground.size());
    for (std::size_t i = 0; i < ground.size(); ++i) {
      const Eigen::Vector3d middle_W = ground.p_W(i) + Eigen::Vector3d(0, 0, 2);
      const bool open = route.fence.contains(middle_W) && may_hover(world, route, middle_W);
      EXPECT_TRUE(!open || places[i] == middle_W) << middle_W.transpose();
      if (!places[i]) continue;
      EXPECT_EQ(ground.at(*places[i]), i);
      EXPECT_TRUE(may_hover(world, route, *places[i]) && route.fence.contains(*places[i])) << places[i]->transpose();
    }
    for (double y_m = 7.0; y_m < 24.0; y_m += 1.0) {
      EXPECT_TRUE(places[ground.at({29.2, y_m, 0.0})]) << "the alley at " << y_m;
    }
  }
}

TEST(HoverPlaces, AreBesideTheMiddleWhereAWallIsTooNearToIt) {
  const std::vector<Box> house{{{20, 5, 0}, {27.5, 25, 6}}};
  const World world = World::of_boxes(house, {{-5, -5, -1}, {35, 35, 12}}, 0.5);
  const RouteConfig route{.margin_m = 0.5,
                          .fence = {.border = polygon_of({-1, 31, -1, 31}), .floor_m = 0.5, .ceiling_m = 11}};
  const CoarseGround ground(world.surface_cells({0, 29, 0, 30}, 0.5), 2.5, 800);  // the last squares 1.5 m wide
  const HoverPlaces places = hover_places(ground, world, route, 2.0);
  for (double y_m = 8.0; y_m < 23.0; y_m += 1.0) {
    const std::size_t square = ground.at({28.2, y_m, 0.0});
    ASSERT_FALSE(may_hover(world, route, ground.p_W(square) + Eigen::Vector3d(0, 0, 2)));
    EXPECT_TRUE(places[square] && ground.at(*places[square]) == square && may_hover(world, route, *places[square]));
  }
}

TEST(HoverPlaces, AreNowhereAboveGroundThatIsClosed) {
  RouteConfig route;
  route.fence.excluded.push_back(polygon_of({10, 20, 10, 20}));
  const World world = World::flat();
  const CoarseGround ground(world.surface_cells({0, 30, 0, 30}, 0.5), 2.5, 800);
  const HoverPlaces places = hover_places(ground, world, route, 2.0);
  for (std::size_t i = 0; i < ground.size(); ++i) {
    const Eigen::Vector3d& p_W = ground.p_W(i);
    EXPECT_EQ(places[i].has_value(), !Area({10, 20, 10, 20}).contains(p_W.x(), p_W.y())) << p_W.transpose();
  }
}

}  // namespace
}  // namespace comptonaut
