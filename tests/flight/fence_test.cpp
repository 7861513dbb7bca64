// SPDX-License-Identifier: BSD-3-Clause
#include "flight/fence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "core/random.h"

namespace comptonaut {
namespace {

/// A star with random rays: it has dents.
Polygon star(Random& random, const Eigen::Vector2d& middle, double radius_m) {
  Polygon polygon;
  const int corners = 3 + static_cast<int>(random() % 8);
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / corners, r = radius_m * random.uniform(0.3, 1.0);
    polygon.emplace_back(middle.x() + r * std::cos(angle), middle.y() + r * std::sin(angle));
  }
  return polygon;
}

Fence random_fence(Random& random) {
  Fence fence{.border = star(random, {0, 0}, 40), .floor_m = 1.0, .ceiling_m = 9.0};
  for (int i = 0; i < 2; ++i) {
    fence.excluded.push_back(star(random, {random.uniform(-20, 20), random.uniform(-20, 20)}, 8));
    fence.keep_out.push_back({{random.uniform(-20, 20), random.uniform(-20, 20)}, random.uniform(1, 5)});
  }
  return fence;
}

Eigen::Vector3d somewhere(Random& random) {
  return {random.uniform(-45, 45), random.uniform(-45, 45), random.uniform(0, 10)};
}

Eigen::Vector3d at(const Leg& leg, double share) { return leg.from_W + share * (leg.to_W - leg.from_W); }

/// Round a circle only the order of the corners round it is one in which no edges cross.
TEST(Polygon, IsSimpleInTheOrderOfItsCornersRoundItAlone) {
  constexpr int kCorners = 6;
  Random random(4);
  std::vector<double> angles;
  for (int i = 0; i < kCorners; ++i)
    angles.push_back(2.0 * std::numbers::pi * (i + random.uniform(0.0, 0.9)) / kCorners);
  std::vector<int> order(kCorners);
  std::iota(order.begin(), order.end(), 0);
  int simple = 0;
  do {
    Polygon polygon;
    bool in_order = true, in_reverse = true;
    for (int i = 0; i < kCorners; ++i) {
      const int corner = order[i], next = order[(i + 1) % kCorners];
      polygon.emplace_back(10.0 * std::cos(angles[corner]), 10.0 * std::sin(angles[corner]));
      in_order = in_order && next == (corner + 1) % kCorners;
      in_reverse = in_reverse && corner == (next + 1) % kCorners;
    }
    ASSERT_EQ(is_simple(polygon), in_order || in_reverse) << testing::PrintToString(order);
    simple += in_order || in_reverse ? 1 : 0;
  } while (std::next_permutation(order.begin(), order.end()));
  EXPECT_EQ(simple, 2 * kCorners);
}

TEST(Polygon, IsSimpleWithDentsButNotWhereEdgesTouch) {
  Random random(5);
  for (int run = 0; run < 1000; ++run) EXPECT_TRUE(is_simple(star(random, {3, 4}, 40))) << "run " << run;
  const std::vector<std::pair<std::string, Polygon>> touching = {
      {"a corner twice", {{0, 0}, {4, 0}, {4, 0}, {0, 4}}},
      {"a corner on another one", {{0, 0}, {4, 0}, {2, 2}, {4, 4}, {0, 4}, {2, 2}}},
      {"a corner on an edge", {{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}},
      {"an edge along another one", {{0, 0}, {6, 0}, {6, 4}, {4, 0}, {2, 0}, {0, 4}}},
      {"back along an edge", {{0, 0}, {4, 0}, {4, 4}, {4, 2}, {0, 2}}},
      {"all in a line", {{0, 0}, {4, 4}, {2, 2}}},
      {"two corners", {{0, 0}, {4, 4}}}};
  for (const auto& [name, polygon] : touching) EXPECT_FALSE(is_simple(polygon)) << name;
}

TEST(Fence, AllowsALegIfEveryPlaceOfItIsAllowed) {
  Random random(1);
  int allowed = 0, refused = 0;
  for (int run = 0; run < 20'000; ++run) {
    const Fence fence = random_fence(random);
    const Leg leg{somewhere(random), somewhere(random)};
    if (!fence.contains(leg.from_W)) continue;
    bool all = true;
    for (int k = 0; k <= 500; ++k) all = all && fence.contains(at(leg, k / 500.0));
    (all ? allowed : refused) += 1;
    ASSERT_TRUE(all || !fence.allows(leg)) << "run " << run << " allowed";
    // Samples may miss a corner that the leg cuts by a hair.
    if (all && !fence.allows(leg)) {
      bool hair = false;
      for (int k = 0; k <= 200'000 && !hair; ++k) hair = !fence.contains(at(leg, k / 200'000.0));
      ASSERT_TRUE(hair) << "run " << run << " refused";
    }
  }
  EXPECT_GT(allowed, 200);
  EXPECT_GT(refused, 500);
}

/// Corners and legs on the points of a lattice: most go exactly through corners and along edges.
TEST(Fence, LegsThroughCornersAndAlongEdgesAreAllowedIfEveryPlaceIs) {
  Random random(3);
  const auto point = [&] {
    return Eigen::Vector2d(static_cast<double>(random() % 7), static_cast<double>(random() % 7));
  };
  int allowed = 0, refused = 0;
  for (int run = 0; run < 50'000; ++run) {
    Fence fence{.floor_m = -1, .ceiling_m = 1};
    const Eigen::Vector2d low = point();
    fence.excluded = {{low, low + Eigen::Vector2d(2, 0), low + Eigen::Vector2d(2, 2), low + Eigen::Vector2d(0, 2)}};
    if (run % 2 == 0) fence.border = {{0, 0}, {6, 0}, {6, 6}, {4, 6}, {3, 3}, {2, 6}, {0, 6}};
    const Eigen::Vector2d from = point(), to = point();
    const Leg leg{{from.x(), from.y(), 0}, {to.x(), to.y(), 0}};
    if (!fence.contains(leg.from_W)) continue;
    bool all = true;
    for (int k = 0; k <= 840; ++k) all = all && fence.contains(at(leg, k / 840.0));
    (all ? allowed : refused) += 1;
    ASSERT_EQ(fence.allows(leg), all) << "run " << run << " from " << from.transpose() << " to " << to.transpose();
  }
  EXPECT_GT(allowed, 5000);
  EXPECT_GT(refused, 5000);
}

TEST(Fence, LetsAMavBackButNotOutAgain) {
  Random random(2);
  int back = 0;
  for (int run = 0; run < 20'000; ++run) {
    Fence fence{.border = star(random, {0, 0}, 30), .floor_m = -100, .ceiling_m = 100};
    const Leg leg{somewhere(random), somewhere(random)};
    if (fence.contains(leg.from_W) || !fence.allows(leg)) continue;
    ++back;
    bool inside = false;
    for (int k = 0; k <= 300; ++k) {
      const bool now = fence.contains(at(leg, k / 300.0));
      ASSERT_TRUE(now || !inside) << "run " << run << " left it again";
      inside = now;
    }
  }
  EXPECT_GT(back, 200);
}

TEST(Fence, LetsAMavOutOfADiscButNotDeeperIntoIt) {
  const Fence fence{.border = {}, .keep_out = {{{0, 0}, 5}}};
  EXPECT_TRUE(fence.allows({{2, 0, 2}, {9, 0, 2}}));
  EXPECT_TRUE(fence.allows({{2, 0, 2}, {3, 0, 2}}));
  EXPECT_FALSE(fence.allows({{2, 0, 2}, {-9, 0, 2}})) << "through the middle";
  EXPECT_FALSE(fence.allows({{9, 4.9, 2}, {-9, 4.9, 2}}));
  EXPECT_TRUE(fence.allows({{9, 5.1, 2}, {-9, 5.1, 2}}));
}

TEST(Fence, LetsAMavComeUpToTheFloor) {
  const Fence fence{.border = {}, .floor_m = 1.0, .ceiling_m = 9.0};
  EXPECT_TRUE(fence.allows({{0, 0, 0.2}, {0, 0, 3}}));
  EXPECT_TRUE(fence.allows({{0, 0, 0.2}, {0, 0, 0.8}}));
  EXPECT_FALSE(fence.allows({{0, 0, 0.2}, {5, 0, 0.2}}));
  EXPECT_FALSE(fence.allows({{0, 0, 3}, {0, 0, 9.5}}));
}

TEST(Fence, TheNearestAllowedPlaceIsAllowedWhereNothingOverlaps) {
  Random random(3);
  for (int run = 0; run < 3000; ++run) {
    Fence fence{.border = {}, .floor_m = 1.0, .ceiling_m = 9.0, .excluded = {star(random, {0, 0}, 40)}};
    const Eigen::Vector3d p_W = somewhere(random);
    const Eigen::Vector3d q_W = fence.nearest_allowed({p_W.x(), p_W.y(), 2});
    EXPECT_TRUE(fence.contains(q_W)) << "run " << run;
    fence.excluded.clear();
    fence.keep_out = {{{3, 4}, 20}};
    const Eigen::Vector3d out_W = fence.nearest_allowed({p_W.x(), p_W.y(), 2});
    EXPECT_TRUE(fence.contains(out_W)) << "run " << run;
    const bool was_allowed = fence.contains({p_W.x(), p_W.y(), 2});
    EXPECT_EQ(out_W.head<2>() == p_W.head<2>(), was_allowed) << "run " << run;
  }
}

}  // namespace
}  // namespace comptonaut
