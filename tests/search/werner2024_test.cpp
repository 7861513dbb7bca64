// SPDX-License-Identifier: BSD-3-Clause
#include "search/werner2024.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "search/search_fixture.h"

namespace comptonaut {
namespace {

Field team_of_three() {
  Field field({0, 50, 0, 50});
  for (int mav = 1; mav <= 3; ++mav) field.add_mav(mav, 4.0 * mav, 0.0);
  return field;
}

TEST(Werner2024, SearchesTheWholeAreaAndNeverLeavesAllWithoutWaypoints) {
  Field field = team_of_three();
  const SearchConfig config;
  Werner2024 strategy(config);
  double seen = 0.0;
  for (int t = 0; t < 120; ++t) {
    const auto courses = strategy.plan(field.state());
    ASSERT_EQ(courses.size(), 3u);
    const auto flying =
        std::count_if(courses.begin(), courses.end(), [](const Course& c) { return !c.points_W.empty(); });
    ASSERT_GT(flying, 0) << "second " << t;
    field.fly(courses, 8.0);
    if (t != 40) continue;
    const auto searched = std::count_if(field.sensitivity_s.begin(), field.sensitivity_s.end(),
                                        [&](double s) { return s >= config.werner2024.s_min_s; });
    seen = static_cast<double>(searched) / static_cast<double>(field.cells.size());
  }
  EXPECT_GT(seen, 0.95);
  EXPECT_GT(strategy.s_min_s(), config.werner2024.s_min_s) << "thresholds ran dry without doubling";
}

TEST(Werner2024, LooksAtMaximaUntilTheyAreKnownWellEnough) {
  Field field = team_of_three();
  std::fill(field.sensitivity_s.begin(), field.sensitivity_s.end(), 6e-8);
  for (const auto& [x, y] : {std::pair{30.5, 40.5}, {10.5, 20.5}, {45.5, 5.5}}) {
    const auto j = *field.cells.find(voxel_at({x, y, -0.5}, 1.0));
    field.lambda_Bq[j] = 1e9;
    field.sensitivity_s[j] = 1e-8;
  }
  Werner2024 strategy(SearchConfig{});
  std::vector<Eigen::Vector3d> targets;
  for (const Course& course : strategy.plan(field.state())) {
    ASSERT_FALSE(course.points_W.empty());
    targets.push_back(course.points_W.back());  // before it, what keeps it out of another's way
  }
  for (const Eigen::Vector3d& p_W : {Eigen::Vector3d(30.5, 40.5, 2), {10.5, 20.5, 2}, {45.5, 5.5, 2}}) {
    EXPECT_NE(std::find(targets.begin(), targets.end(), p_W), targets.end()) << p_W.transpose();
  }
  EXPECT_EQ(strategy.s_min_s(), Werner2024Config{}.s_min_s);
}

TEST(Werner2024, KeepsItsListsBetweenEventsAndTheLegThatIsFlownAlways) {
  Field field = team_of_three();
  Werner2024 strategy(SearchConfig{});
  auto before = strategy.plan(field.state());
  for (int t = 0; t < 60; ++t) {
    field.fly(before, 4.0);
    const auto after = strategy.plan(field.state());
    // Where MAV 1, which gives way to nobody, goes now is a place that it was told to go to before, unless it has been
    // everywhere.
    const auto& old = before.front().points_W;
    auto rest = old;
    take_reached(rest, field.mavs.front().track_W, 1.0);
    if (rest.empty()) rest = {after.front().points_W.front()};
    EXPECT_EQ(after.front().points_W.front(), rest.front()) << "second " << t;
    before = after;
  }
}

TEST(Werner2024, ForgetsVisitsAndLiftsTheirFilterBeforeItDoubles) {
  Field field({0, 3, 0, 3});  // nine cells: all of them soon visited
  for (int mav = 1; mav <= 2; ++mav) field.add_mav(mav, 10.0 * mav, 0.0);
  Werner2024 strategy(SearchConfig{});
  for (int t = 0; t < 15; ++t) field.fly(strategy.plan(field.state()), 8.0, false);
  EXPECT_EQ(strategy.s_min_s(), Werner2024Config{}.s_min_s) << "the same nine cells again";
  std::fill(field.sensitivity_s.begin(), field.sensitivity_s.end(), 1e-6);
  for (int t = 0; t < 15; ++t) field.fly(strategy.plan(field.state()), 8.0, false);
  EXPECT_GT(strategy.s_min_s(), 1e-6);
}

TEST(Werner2024, IsDeterministic) {
  const auto run = [] {
    Field field = team_of_three();
    Werner2024 strategy(SearchConfig{});
    std::vector<Eigen::Vector3d> all;
    for (int t = 0; t < 30; ++t) {
      const auto courses = strategy.plan(field.state());
      for (const Course& course : courses) all.insert(all.end(), course.points_W.begin(), course.points_W.end());
      field.fly(courses, 8.0);
    }
    return all;
  };
  EXPECT_EQ(run(), run());
}

}  // namespace
}  // namespace comptonaut
