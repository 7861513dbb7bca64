// SPDX-License-Identifier: BSD-3-Clause
#include "search/look_first.h"

#include <gtest/gtest.h>

#include "search/search_fixture.h"

namespace comptonaut {
namespace {

SearchConfig looking_first(const Area& area) {
  SearchConfig config{.strategy = "zigzag"};
  config.look_first = {area};
  return config;
}

/// Seconds until each place of the area has been within `near_m` of a track; -1: not in time.
int seconds_until_seen(Field& field, Strategy& strategy, const Area& area, double near_m) {
  std::vector<Eigen::Vector3d> open;
  for (double x = area.x_min_m + 0.5; x < area.x_max_m; ++x) {
    for (double y = area.y_min_m + 0.5; y < area.y_max_m; ++y) open.emplace_back(x, y, 2.0);
  }
  for (int t_s = 1; t_s <= 60; ++t_s) {
    field.fly(strategy.plan(field.state()), 5.0, false);
    std::erase_if(open, [&](const Eigen::Vector3d& p_W) {
      return std::ranges::any_of(field.mavs, [&](const Searcher& mav) {
        return std::ranges::any_of(mav.track_W,
                                   [&](const Eigen::Vector3d& q_W) { return (q_W - p_W).norm() <= near_m; });
      });
    });
    if (open.empty()) return t_s;
  }
  return -1;
}

TEST(LookFirst, SeesTheAreaFirstAndMuchSoonerThanTheStrategyAlone) {
  const Area area{30, 42, 30, 42};
  const auto run = [&](const SearchConfig& config) {
    Field field({0, 50, 0, 50});
    field.add_mav(1, 1, 1);
    field.add_mav(2, 9, 1);
    const auto strategy = make_strategy(config);
    return seconds_until_seen(field, *strategy, area, 3.5);
  };
  const int alone_s = run({.strategy = "zigzag"}), first_s = run(looking_first(area));
  EXPECT_GT(first_s, 0);
  EXPECT_LT(first_s, 25);
  EXPECT_TRUE(alone_s < 0 || alone_s > first_s + 20) << alone_s;
}

TEST(LookFirst, ThenTheOtherStrategyLeads) {
  Field field({0, 50, 0, 50});
  field.add_mav(1, 1, 1);
  const auto strategy = make_strategy(looking_first({2, 6, 2, 6}));
  std::vector<Course> course;
  double farthest_m = 0.0;
  for (int t_s = 0; t_s < 40; ++t_s) {
    field.fly(course = strategy->plan(field.state()), 5.0, false);
    farthest_m = std::max(farthest_m, field.mavs[0].p_W.norm());
  }
  EXPECT_EQ(course[0].status, "searching");
  EXPECT_GT(farthest_m, 40.0) << "beyond what is looked at first";
}

TEST(LookFirst, WhoIsLeftTakesOverWhatOneThatDroppedOutHadToSee) {
  const Area area{20, 44, 20, 44};
  Field field({0, 50, 0, 50});
  field.add_mav(1, 1, 1);
  field.add_mav(2, 9, 1);
  const auto strategy = make_strategy(looking_first(area));
  field.fly(strategy->plan(field.state()), 5.0, false);
  field.mavs.erase(field.mavs.begin());
  EXPECT_GT(seconds_until_seen(field, *strategy, area, 3.5), 0);
}

TEST(LookFirst, LeavesOutWhereNobodyMayBe) {
  Field field({0, 50, 0, 50});
  field.add_mav(1, 1, 1);
  SearchConfig config = looking_first({20, 30, 20, 30});
  config.route.fence.excluded = {polygon_of({15, 35, 15, 35})};
  const auto strategy = make_strategy(config), alone = make_strategy({.strategy = "zigzag"});
  EXPECT_EQ(strategy->plan(field.state())[0].points_W.front(), alone->plan(field.state())[0].points_W.front());
}

}  // namespace
}  // namespace comptonaut
