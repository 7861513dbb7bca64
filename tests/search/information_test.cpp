// SPDX-License-Identifier: BSD-3-Clause
#include "search/information.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/random.h"
#include "search/outlook.h"

namespace comptonaut {
namespace {

TEST(Lookahead, EndsNoLegWhereNobodyMayBe) {
  Field field({0, 60, 0, 60});
  SearchConfig config = information_config();
  const Area closed{20, 40, 20, 40};
  config.route.fence.excluded.push_back(polygon_of(closed));
  const Outlook outlook(field, 0.0, {source_at(30, 30, 1e9, 5.0)}, config);
  const Lookahead lookahead = outlook.lookahead();
  const FlightPath start = start_flight({5, 30, 2}, {0, 0, 0}, outlook.open());
  const FlightPath path = polished(lookahead, start, best_flight(lookahead, start, {}));
  ASSERT_FALSE(path.points_W.empty());
  for (const Eigen::Vector3d& p_W : path.points_W) {
    EXPECT_TRUE(outlook.prospect.flyable[outlook.ground.at(p_W)]) << p_W.transpose();
  }
}

TEST(Lookahead, FasterOrLongerFlightsTakeTheTimeThatAccelerationAllows) {
  Field field({0, 50, 0, 50});
  const Outlook outlook(field);
  Lookahead lookahead = outlook.lookahead();
  lookahead.acceleration_max_m_s2 = 4.0;
  const auto leg_north = [&](const Eigen::Vector3d& v_W, const Eigen::Vector3d& to_W) {
    return with_leg(lookahead, start_flight({5, 5, 2}, v_W, outlook.open()), to_W);
  };
  const FlightPath flown = leg_north({0, 0, 0}, {5, 37, 2});
  EXPECT_NEAR(flown.time_s, 2.0 + (32.0 - 8.0) / 8.0, 0.05);  // 2 s to 8 m/s, which take 8 m
  EXPECT_NEAR(flown.v_W.y(), 8.0, 1e-9);
  EXPECT_NEAR(leg_north({0, 8, 0}, {5, 37, 2}).time_s, 4.0, 1e-6);
  EXPECT_GT(leg_north({0, 8, 0}, {37, 5, 2}).time_s, flown.time_s);
}

TEST(Lookahead, SharperCornersTakeLongerAndStraightOnesNoTime) {
  Field field({0, 100, 0, 100});
  const Outlook outlook(field);
  const Lookahead lookahead = outlook.lookahead();
  const FlightPath first = with_leg(lookahead, start_flight({50, 10, 2}, {0, 8, 0}, outlook.open()), {50, 50, 2});
  EXPECT_NEAR(with_leg(lookahead, first, {50, 90, 2}).time_s, 10.0, 1e-6);
  double before_s = 10.0;
  for (const double angle_rad : {0.5, 0.8, 1.5, 3.0}) {
    const Eigen::Vector3d to_W(50.0 + 40.0 * std::sin(angle_rad), 50.0 + 40.0 * std::cos(angle_rad), 2.0);
    const double time_s = with_leg(lookahead, first, to_W).time_s;
    EXPECT_GT(time_s, before_s) << angle_rad;
    before_s = time_s;
  }
  EXPECT_LT(before_s, 12.1);  // a full stop and back takes 2 s more than flying on
}

TEST(Lookahead, FindsAFlightWhereverThereIsRoomAndPolishingNeverHarms) {
  Random random(11);
  for (int trial = 0; trial < 20; ++trial) {
    Field field({0, random.uniform(20, 60), 0, random.uniform(20, 60)});
    const Outlook outlook(field, random.uniform(0, 20), {source_at(2, 3, 1e9, random.uniform(0.01, 3))});
    const Lookahead lookahead = outlook.lookahead();
    const FlightPath start = start_flight({random.uniform(-5, 30), random.uniform(-5, 30), 2},
                                          {random.uniform(-5, 5), random.uniform(-5, 5), 0}, outlook.open());
    const FlightPath best = best_flight(lookahead, start, {});
    EXPECT_GT(best.time_s, 0.0) << "trial " << trial;
    EXPECT_GE(best.gain, 0.0) << "trial " << trial;
    EXPECT_GE(polished(lookahead, start, best).score, best.score) << "trial " << trial;
  }
}

TEST(Information, TwoMavsDoNotChooseTheSamePlace) {
  Field field({0, 50, 0, 50});
  field.add_mav(1, 23, 25);
  field.add_mav(2, 27, 25);
  Information information(information_config());
  const auto courses = information.plan(field.state());
  for (const Course& course : courses) ASSERT_FALSE(course.points_W.empty()) << course.status;
  EXPECT_GT((courses[0].points_W[0] - courses[1].points_W[0]).norm(), 5.0);
  EXPECT_GT((courses[0].points_W.back() - courses[1].points_W.back()).norm(), 5.0);
}

TEST(Information, FliesToASourceThatIsNotKnownWellEnough) {
  Field field({0, 50, 0, 50});
  field.add_mav(1, 40, 40);
  std::vector<SourceEstimate> sources{source_at(12, 30, 1e8, 3.0)};
  SearchConfig config = information_config();
  config.information.source_weight = 100.0;
  Information information(config);
  double nearest_m = 1e9;
  for (int t = 0; t < 15; ++t) {
    SearchState state = field.state();
    state.sources = sources;
    field.fly(information.plan(state), 8.0);
    for (const auto& p_W : field.mavs[0].track_W) {
      nearest_m = std::min(nearest_m, (p_W - sources[0].p_W).head<2>().norm());
    }
  }
  EXPECT_LT(nearest_m, 2.5);
}

class Mission {
 public:
  Mission(Field field, std::vector<SourceEstimate> sources, const SearchConfig& config = information_config())
      : field_(std::move(field)), sources_(std::move(sources)), information_(config) {}

  std::vector<Course> second() {
    SearchState state = field_.state();
    state.sources = sources_;
    auto courses = information_.plan(state);
    field_.fly(courses, 6.0);
    return courses;
  }

  Field field_;
  std::vector<SourceEstimate> sources_;
  Information information_;
};

TEST(Information, EndsWhenAllIsClearSaysSoAndFliesHome) {
  Field field({0, 30, 0, 30});
  for (int mav = 1; mav <= 3; ++mav) field.add_mav(mav, 4.0 * mav, 1.0);
  const std::vector<Searcher> start = field.mavs;
  Mission mission(field, {source_at(10, 20, 1e9, 0.1)});
  std::vector<Course> courses;
  int t = 0;
  do {
    courses = mission.second();
  } while (!courses[0].status.starts_with("clear above 1e+08 Bq, 1 sources within 0.25 m") && ++t < 400);
  ASSERT_LT(t, 400) << courses[0].status;
  for (int i = 0; i < 30; ++i) courses = mission.second();
  for (std::size_t i = 0; i < start.size(); ++i) {
    EXPECT_LE((mission.field_.mavs[i].p_W - start[i].p_W).norm(), 1.0) << "MAV " << i + 1;
    EXPECT_TRUE(courses[i].status.ends_with("at home")) << courses[i].status;
  }
  mission.sources_.push_back(source_at(25, 25, 2e8, 2.0));  // and goes on when a source appears
  courses = mission.second();
  EXPECT_TRUE(std::ranges::any_of(courses, [](const Course& course) { return course.status == "searching"; }));
}

TEST(Information, DoesNotEndWhileASourceIsUncertainAlongEitherAxis) {
  Field field({0, 20, 0, 20});
  field.add_mav(1, 1, 1);
  Mission mission(field, {source_at(10, 10, 1e9, 0.2)});
  const auto is_over = [&] { return mission.second()[0].status.starts_with("clear"); };
  int t = 0;
  while (!is_over() && ++t < 400) {
  }
  ASSERT_LT(t, 400) << "what follows tests nothing";
  for (const auto& [x_sigma_m, y_sigma_m] : {std::pair(1.0, 1.0), {1.0, 0.2}, {0.2, 1.0}}) {
    mission.sources_[0].position_sigma_m = {x_sigma_m, y_sigma_m, 0.0};
    for (t = 0; t < 30; ++t) EXPECT_FALSE(is_over()) << x_sigma_m << ", " << y_sigma_m << ", second " << t;
    mission.sources_[0].position_sigma_m = {0.2, 0.2, 1.0};  // its height is not asked for
    EXPECT_TRUE(is_over()) << "after " << x_sigma_m << ", " << y_sigma_m;
  }
}

/// Some of the 25 x 20 m beyond the fence is seen from within, but not what lies 15 m away.
TEST(Information, EndsAndSaysHowMuchGroundTheFenceExcludes) {
  Field field({0, 40, 0, 20});
  field.add_mav(1, 1, 1);
  SearchConfig config = information_config();
  config.route.fence.border = polygon_of({-5, 15, -5, 25});
  Mission mission(field, {}, config);
  const auto status = [&] { return mission.second()[0].status; };
  int t = 0;
  while (!status().starts_with("clear above 1e+08 Bq but for ") && ++t < 120) {
  }
  ASSERT_LT(t, 120) << "it hangs about at the fence";
  const std::string said = status();
  EXPECT_NE(said.find(" m2 over which nobody may fly, 0 sources"), std::string::npos) << said;
  const double unseen_m2 = std::stod(said.substr(said.find("but for ") + 8));
  EXPECT_GE(unseen_m2, 10.0 * 20.0) << said;
  EXPECT_LE(unseen_m2, 25.0 * 20.0) << said;
}

TEST(Information, SameStatesGiveTheSamePlansBitForBit) {
  const auto fly = [] {
    Field field({0, 50, 0, 50});
    for (int mav = 1; mav <= 3; ++mav) field.add_mav(mav, 4.0 * mav, 1.0);
    Mission mission(field, {source_at(10, 20, 1e9, 0.7), source_at(40, 33, 3e8, 1.5)});
    std::vector<Eigen::Vector3d> flown;
    for (int t = 0; t < 30; ++t) {
      for (const Course& course : mission.second()) {
        flown.insert(flown.end(), course.points_W.begin(), course.points_W.end());
      }
    }
    return flown;
  };
  EXPECT_EQ(fly(), fly());
}

TEST(Information, CoversTheWholeFieldForTheWeakestSource) {
  Field field({0, 40, 0, 40});
  field.add_mav(1, 1, 1);
  field.add_mav(2, 5, 1);
  Mission mission(field, {});
  int t = 0;
  while (!mission.second()[0].status.starts_with("clear") && ++t < 300) {
  }
  ASSERT_LT(t, 300);
  // 25 counts of 1e8 Bq at 1e-6 need 0.25 s / m^2 at the least, against the background more.
  for (std::size_t j = 0; j < field.cells.size(); ++j) EXPECT_GT(mission.field_.sensitivity_s[j], 0.25 * 3e-8) << j;
}

TEST(Information, StartsOutsideAreaWithoutMavsOrOnASingleCell) {
  Field field({0, 50, 0, 50});
  Information none(information_config());
  EXPECT_TRUE(none.plan(field.state()).empty());
  field.add_mav(7, -6, 20);
  Information outside(information_config());
  EXPECT_FALSE(outside.plan(field.state())[0].points_W.empty());
  Field tiny({0, 1, 0, 1});
  tiny.add_mav(1, 0.5, 0.5);
  Information spot(information_config());
  EXPECT_EQ(spot.plan(tiny.state()).size(), 1u);
}

TEST(Information, UnknownPrecisionOrNothingLeftDoesNoHarm) {
  Field field({0, 20, 0, 20});
  field.add_mav(1, 1, 1);
  const double nan = SourceEstimate::kUnknown;
  Mission mission(field, {source_at(10, 10, 1e9, nan)});
  for (int t = 0; t < 100; ++t) {
    for (const Course& course : mission.second()) {
      for (const Eigen::Vector3d& p_W : course.points_W) ASSERT_TRUE(p_W.allFinite()) << "second " << t;
    }
  }
}

}  // namespace
}  // namespace comptonaut
