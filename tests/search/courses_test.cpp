// SPDX-License-Identifier: BSD-3-Clause
#include "search/courses.h"

#include <gtest/gtest.h>

#include "config/config.h"
#include "search/search_fixture.h"

namespace comptonaut {
namespace {

using Points = std::vector<Eigen::Vector3d>;

TEST(TakeReached, TakesTargetsInTheirOrderAlongTheTrack) {
  const Points all{{5, 0, 2}, {5, 5, 2}, {0, 0, 2}};
  Points targets = all;
  EXPECT_EQ(take_reached(targets, {{0, 0, 2}, {5, 0.5, 2}, {5, 4.5, 2}}, 1.0), Points(all.begin(), all.begin() + 2));
  EXPECT_EQ(targets, Points{all[2]}) << "the track began there, but before the others";
}

TEST(TakeReached, SeesTargetsBetweenTwoPointsOfTheTrack) {
  Points targets{{5, 0.9, 7}};
  EXPECT_EQ(take_reached(targets, {{0, 0, 2}, {10, 0, 2}}, 1.0).size(), 1u);
  targets = {{5, 1.1, 2}};
  EXPECT_TRUE(take_reached(targets, {{0, 0, 2}, {10, 0, 2}}, 1.0).empty());
  EXPECT_TRUE(take_reached(targets, {}, 1.0).empty());
}

TEST(MakeCourses, OnFreeGroundACourseIsItsTargets) {
  Field field({0, 50, 0, 50});
  field.add_mav(1, 0, 0);
  field.add_mav(4, 40, 0);
  Targets targets{{1, {{10, 0, 2}, {10, 10, 2}}}, {4, {{40, 20, 2}}}};
  const auto courses = make_courses(field.state(), {}, targets);
  EXPECT_EQ(courses[0].points_W, targets[1]);
  EXPECT_EQ(courses[1].points_W, targets[4]);
  EXPECT_EQ(courses[0].status, "searching");
}

TEST(MakeCourses, TheHigherNumberKeepsOutOfTheLowerOnesWay) {
  Field field({0, 50, 0, 50});
  field.add_mav(1, 10, 20);
  field.add_mav(2, 20, 10);
  const SearchConfig config;
  Targets targets{{1, {{30, 20, 2}}}, {2, {{20, 30, 2}, {30, 8, 2}}}};  // they would cross at (20, 20)
  const auto courses = make_courses(field.state(), config, targets);
  EXPECT_EQ(courses[0].points_W, targets[1]);
  const Leg first{.from_W = {10, 20, 2}, .to_W = {30, 20, 2}};
  Eigen::Vector3d from_W(20, 10, 2);
  ASSERT_FALSE(courses[1].points_W.empty());
  for (const Eigen::Vector3d& to_W : courses[1].points_W) {
    EXPECT_FALSE(sweep_meets(config.route.separation, Leg{.from_W = from_W, .to_W = to_W}, first)) << to_W.transpose();
    from_W = to_W;
    if (to_W == targets[2].front()) break;
  }
}

TEST(MakeCourses, TwoThatStandInEachOthersWayGetPast) {
  Field field({0, 50, 0, 50});
  field.add_mav(1, 20, 20);
  field.add_mav(2, 24, 20);
  const SearchConfig config;
  const auto way_of_first = [&] {
    Targets targets{{1, {{40, 20, 2}}}, {2, {{5, 20, 2}}}};
    return make_courses(field.state(), config, targets)[0].points_W;
  };
  const Leg place{.from_W = field.mavs[1].p_W, .to_W = field.mavs[1].p_W};
  Eigen::Vector3d from_W = field.mavs[0].p_W;
  for (const Eigen::Vector3d& to_W : way_of_first()) {
    EXPECT_TRUE(keeps_apart(config.route.separation, {from_W, to_W}, place)) << to_W.transpose();
    from_W = to_W;
  }
  EXPECT_EQ(from_W, Eigen::Vector3d(40, 20, 2));
  field.mavs[1].v_W = {-4, 0, 0};  // it will be gone
  EXPECT_EQ(way_of_first(), (Points{{40, 20, 2}}));
}

TEST(MakeCourses, ATargetWithoutAWayIsReportedAndTheNextComesFirst) {
  Field field({0, 50, 0, 50});
  field.add_mav(1, 0, 0);
  const Eigen::Vector3d underground(10, 0, -5);
  Targets targets{{1, {underground, {20, 0, 2}}}};
  auto courses = make_courses(field.state(), {}, targets);
  EXPECT_EQ(courses[0].points_W, (Points{{20, 0, 2}}));
  EXPECT_EQ(courses[0].status, "no way to (10.0, 0.0, -5.0): it is at an obstacle or in unknown space");
  EXPECT_EQ(targets[1].size(), 2u);
  targets[1] = {underground};
  courses = make_courses(field.state(), {}, targets);
  EXPECT_TRUE(courses[0].points_W.empty());
  EXPECT_EQ(courses[0].status, "no way to (10.0, 0.0, -5.0): it is at an obstacle or in unknown space");
}

TEST(MakeCourses, SaysInWordsWhyThereIsNoWay) {
  const auto status = [](const SearchConfig& config, const Points& list, double x_m = 0.0) {
    Field field({0, 50, 0, 50});
    field.add_mav(1, x_m, 0);
    Targets targets{{1, list}};
    return make_courses(field.state(), config, targets)[0].status;
  };
  SearchConfig config;
  EXPECT_EQ(status(config, {}), "nothing to visit");
  config.route.fence.border = polygon_of({-1, 8, -1, 8});
  EXPECT_EQ(status(config, {{20, 0, 2}}), "no way to (20.0, 0.0, 2.0): it is outside the fence");
  config.route.fence = {};
  config.route.fence.excluded = {polygon_of({5, 9, -90, 90})};
  config.route.expanded_max = 100;
  EXPECT_EQ(status(config, {{20, 0, 2}}), "no way to (20.0, 0.0, 2.0): it is walled in, or farther than 100 steps");
}

TEST(MakeCourses, KeepsAwayFromStrongSourcesAndExcludedAreas) {
  Field field({0, 50, 0, 50});
  field.add_mav(1, 0, 20);
  SearchConfig config;
  config.keep_out = {.activity_min_Bq = 1e9, .radius_m = 6.0};
  config.route.fence.excluded = {polygon_of({30, 34, 0, 50})};
  const std::vector<SourceEstimate> sources{{.p_W = {15, 20, 0}, .activity_Bq = 2e9},
                                            {.p_W = {5, 20, 0}, .activity_Bq = 5e8}};
  SearchState state = field.state();
  state.sources = sources;
  Targets targets{{1, {{28, 20, 2}, {16, 20, 2}, {31, 20, 2}}}};
  const Points course = make_courses(state, config, targets)[0].points_W;
  Eigen::Vector3d from_W(0, 20, 2);
  ASSERT_GE(course.size(), 4u) << "straight through";
  for (const Eigen::Vector3d& to_W : course) {
    for (double share = 0.0; share <= 1.0; share += 0.01) {
      const Eigen::Vector3d p_W = from_W + share * (to_W - from_W);
      EXPECT_GE((p_W - Eigen::Vector3d(15, 20, 2)).norm(), 6.0 - 1e-6) << p_W.transpose();
      EXPECT_LE(p_W.x(), 30.0) << p_W.transpose();
    }
    from_W = to_W;
  }
  EXPECT_LT((targets[1][1] - Eigen::Vector3d(21.1, 20, 2)).norm(), 1e-6) << "moved to where one may be";
}

TEST(MakeStrategy, KnowsItsNamesAndRefusesOthers) {
  EXPECT_NE(make_strategy({.strategy = "werner2024"}), nullptr);
  EXPECT_NE(make_strategy({.strategy = "zigzag"}), nullptr);
  EXPECT_EQ(make_strategy({.strategy = "none"}), nullptr);
  EXPECT_THROW(make_strategy({.strategy = "zag"}), std::invalid_argument);
}

TEST(SearchConfig, IsReadWithItsSections) {
  const SearchConfig config = parse_config(
      "strategy: zigzag\nzigzag: {lane_m: 6}\nwerner2024: {s_min_s: 1e-9}\nroute: {expanded_max: 7}\n"
      "keep_out: {activity_min_Bq: 1e9, radius_m: 4}\nlook_first: [{x_min_m: 1, x_max_m: 3, y_min_m: 1, y_max_m: 3}]\n"
      "exclude: [{x_min_m: 5, x_max_m: 9, y_min_m: 1, y_max_m: 3}]",
      "a.yaml", read_search_config);
  EXPECT_EQ(config.strategy, "zigzag");
  EXPECT_EQ(config.zigzag.lane_m, 6.0);
  EXPECT_EQ(config.werner2024.s_min_s, 1e-9);
  EXPECT_EQ(config.route.expanded_max, 7u);
  EXPECT_EQ(config.keep_out.radius_m, 4.0);
  EXPECT_EQ(config.look_first, (std::vector<Area>{{1, 3, 1, 3}}));
  EXPECT_EQ(config.route.fence.excluded.size(), 1u);
  EXPECT_THROW((void)parse_config("zigzag: {lane: 6}", "a.yaml", read_search_config), ConfigError);
}

}  // namespace
}  // namespace comptonaut
