// SPDX-License-Identifier: BSD-3-Clause
#include "search/prospect.h"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "core/random.h"
#include "search/outlook.h"

namespace comptonaut {
namespace {

TEST(CoarseGround, EveryCellHasASquareNearby) {
  const Cells cells = flat_cells({-3.2, 17.9, 4.1, 30.3}, 0.5);
  const CoarseGround ground(cells, 2.5, 1600);
  for (std::size_t j = 0; j < cells.size(); ++j) {
    const Eigen::Vector3d away = ground.p_W(ground.at(cells.p_W(j))) - cells.p_W(j);
    ASSERT_LE(away.head<2>().lpNorm<Eigen::Infinity>(), 2.5) << cells.p_W(j).transpose();
  }
  EXPECT_LE(CoarseGround(cells, 2.5, 20).size(), 40u);  // squares at the border are cut
}

TEST(CoarseGround, BeyondTheCellsAndInHolesTheNearestSquareCounts) {
  std::vector<Cells::Cell> ring;
  for (int x = 0; x < 30; ++x) {
    for (int y = 0; y < 30; ++y) {
      if (x > 4 && x < 25 && y > 4 && y < 25) continue;
      ring.push_back({.key = {x, y, 0}, .p_W = {x + 0.5, y + 0.5, 0.0}});
    }
  }
  const CoarseGround ground(Cells(1.0, ring), 2.5, 1600);
  EXPECT_EQ(ground.at({-100.0, -100.0, 2.0}), ground.at({0.1, 0.1, 0.0}));
  EXPECT_EQ(ground.at({100.0, 15.0, 2.0}), ground.at({29.9, 15.0, 0.0}));
  EXPECT_LE((ground.p_W(ground.at({7.0, 15.0, 2.0})) - Eigen::Vector3d(7.0, 15.0, 0.0)).norm(), 5.0);
}

TEST(Prospect, TimeInViewOnlyEverAddsAndEachSecondAddsLess) {
  Field field({0, 30, 0, 20});
  const std::vector<SourceEstimate> sources{source_at(8, 9, 2e9, 1.0)};
  const Outlook outlook(field, 0.0, sources);
  ASSERT_TRUE((outlook.prospect.per_s >= 0.0F).all());
  for (Eigen::Index i = 0; i < outlook.prospect.per_s.cols(); ++i) {
    Eigen::ArrayXf open = outlook.open();
    double before = 1e9;
    for (int second = 0; second < 10; ++second) {
      Looks looks(open.size());
      looks.add(outlook.prospect.views[static_cast<std::size_t>(i)], 1.0);
      const double gain = looks.answer(open);
      ASSERT_GT(gain, 0.0) << "square " << i << " second " << second;
      ASSERT_LE(gain, before * (1.0 + 1e-3)) << "square " << i << " second " << second;
      before = gain;
    }
  }
}

TEST(Prospect, StrongSourcesAreFoundFirst) {
  Field field({0, 20, 0, 20});
  const Outlook outlook(field, 1e-4);
  const Eigen::Index squares = outlook.prospect.per_s.cols();
  ASSERT_EQ(outlook.prospect.known.size(), 3 * squares);
  const auto weak = outlook.prospect.weight.head(squares);
  const auto strong = outlook.prospect.weight.segment(2 * squares, squares);
  EXPECT_TRUE((strong < weak).all());
  EXPECT_TRUE(
      (outlook.prospect.per_s.middleRows(2 * squares, squares) > outlook.prospect.per_s.topRows(squares)).all());
}

TEST(Prospect, CountsThatNobodyExplainsDrawAndEmptyGroundDoesNot) {
  Field field({0, 50, 0, 50});
  const Outlook fresh(field);
  const Eigen::Index squares = fresh.prospect.per_s.cols();
  const auto at = [&](double x_m, double y_m) { return static_cast<Eigen::Index>(fresh.ground.at({x_m, y_m, 0.0})); };
  std::vector<std::vector<Look>> all_looks(1);
  std::vector<Look>& looks = all_looks[0];
  for (double x_m = 5.0; x_m < 45.0; x_m += 0.4) {  // a pass at 8 m/s, singles of a weak source at its middle
    const bool near = std::abs(x_m - 25.0) < 1.5;
    looks.push_back({.p_WD = {x_m, 25.0, 2.0}, .live_s = 0.05, .singles = near ? 2.0 : 0.0, .expected = 0.15});
  }
  SearchState state = field.state();
  state.looks = all_looks;
  Eigen::ArrayXf live_s = Eigen::ArrayXf::Zero(squares);
  for (const Look& look : looks) live_s(static_cast<Eigen::Index>(fresh.ground.at(look.p_WD))) += 0.05F;
  const Prospect prospect = make_prospect(fresh.ground, singles_kernels(fresh.ground, state, 2.0), state, fresh.config,
                                          live_s, fresh.hover_W);
  ASSERT_TRUE((prospect.weight.head(squares) > 0.0F).all());  // of the least activity nothing is left out
  EXPECT_GT(prospect.weight(at(25, 25)), 5.0F * prospect.weight(at(25, 3)));
  EXPECT_LT(prospect.weight(at(9, 25)), 0.2F * prospect.weight(at(25, 3)));
  EXPECT_GT(prospect.per_s(at(25, 25), at(25, 25)), 1.1F * fresh.prospect.per_s(at(25, 25), at(25, 25)))
      << "part of the proof is there";
}

TEST(Prospect, WhatIsAnsweredIsLeftOut) {
  Field field({0, 20, 0, 20});
  const Eigen::Index squares = Outlook(field).prospect.per_s.cols();
  Eigen::Index before = 3 * squares;
  for (const double live_s : {1e-4, 0.1, 100.0}) {
    const Prospect& prospect = Outlook(field, live_s).prospect;
    EXPECT_LE(prospect.known.size(), before) << live_s;
    EXPECT_EQ(prospect.all_clear, live_s == 100.0) << live_s;
    before = prospect.known.size();
  }
  EXPECT_EQ(before, 0);
}

TEST(Prospect, AKnownSourceHidesWeakOnesNearby) {
  Field field({0, 50, 0, 50});
  const Outlook bare(field), hidden(field, 0.0, {source_at(25, 25, 2e9, 0.1)});
  const auto j = static_cast<Eigen::Index>(bare.ground.at({30.0, 25.0, 0.0}));
  EXPECT_LT(hidden.prospect.per_s.matrix()(j, j), 0.5F * bare.prospect.per_s.matrix()(j, j));
}

TEST(Prospect, APreciseSourceIsStillVisitedOnceAndThenNoMore) {
  Field field({0, 50, 0, 50});
  const SourceEstimate source = source_at(25, 25, 2e9, 0.01);
  Outlook outlook(field, 0.0, {source});
  const auto visit = outlook.prospect.weight.size() - 1;  // the position is known
  EXPECT_FLOAT_EQ(outlook.prospect.weight(visit), static_cast<float>(outlook.config.information.visit_weight));
  EXPECT_FLOAT_EQ(outlook.prospect.known(visit), 0.0F);
  const auto per_s = [&](double x_m) {
    return outlook.prospect.per_s(visit, static_cast<Eigen::Index>(outlook.ground.at({x_m, 25.0, 0.0})));
  };
  EXPECT_GT(per_s(25.0), 10.0F * per_s(33.0));
  EXPECT_GT(per_s(25.0) * outlook.config.information.visit_s, 0.8);  // the square's centre is nearly above it

  Eigen::ArrayXf live_s = Eigen::ArrayXf::Zero(outlook.prospect.per_s.cols());
  live_s(static_cast<Eigen::Index>(outlook.ground.at(source.p_W))) =
      10.0F * static_cast<float>(outlook.config.information.visit_s);
  SearchState state = field.state();
  const std::vector<SourceEstimate> sources{source};
  state.sources = sources;
  const Prospect after = make_prospect(outlook.ground, singles_kernels(outlook.ground, state, 2.0), state,
                                       outlook.config, live_s, outlook.hover_W);
  EXPECT_TRUE((after.weight < 0.5F * static_cast<float>(outlook.config.information.visit_weight)).all());
}

TEST(Prospect, ASourceIsPreciseOnceItIsSoAlongEachAxis) {
  Field field({0, 20, 0, 20});
  const double asked_m = information_config().information.source_sigma_m;
  for (const auto& [x_sigma, y_sigma, precise] :
       {std::tuple(0.9, 0.9, true), {0.1, 1.1, false}, {1.1, 0.1, false}, {1.1, 1.1, false}}) {
    SourceEstimate source = source_at(10, 10, 1e9, 0.0);
    source.position_sigma_m = Eigen::Vector3d(x_sigma * asked_m, y_sigma * asked_m, 0.0);
    EXPECT_EQ(Outlook(field, 0.0, {source}).prospect.all_precise, precise) << x_sigma << ", " << y_sigma;
    EXPECT_FALSE(Outlook(field, 0.0, {source_at(3, 3, 1e9, 2.0 * asked_m), source}).prospect.all_precise)
        << "beside one that is not";
  }
}

TEST(OpenQuestions, LooksAnswerByTheirFormula) {
  Random random(5);
  for (const Eigen::Index questions : {0, 1, 15, 16, 17, 333}) {
    const auto n = static_cast<std::size_t>(questions);
    std::vector<double> weight(n), known(n);
    Eigen::ArrayXf weights(questions), knowns(questions);
    Eigen::ArrayXXf per_s(questions, 3);
    for (Eigen::Index k = 0; k < questions; ++k) {
      knowns(k) = static_cast<float>(std::pow(10.0, 10.0 * random.uniform() - 9.0));  // 1e-9 to 10
      weights(k) = static_cast<float>(random.uniform());
      for (int i = 0; i < 3; ++i) per_s(k, i) = static_cast<float>(random.uniform() < 0.3 ? random.uniform() : 0.0);
      if (k / 16 % 2 == 1) per_s(k, 2) = 4e-4F;  // next to nothing
      weight[static_cast<std::size_t>(k)] = static_cast<double>(weights(k));
      known[static_cast<std::size_t>(k)] = static_cast<double>(knowns(k));
    }
    const std::vector<View> views = views_of(per_s);
    Eigen::ArrayXf open = open_weight(weights, knowns);
    for (const auto& [i, j] : {std::pair(0, 1), {2, 2}, {0, 2}, {1, 1}}) {
      double gain = 0.0, all = 0.0;
      for (std::size_t k = 0; k < n; ++k) {
        const auto at = static_cast<Eigen::Index>(k);
        const double more = 0.7 * static_cast<double>(per_s(at, i)) + 0.2 * static_cast<double>(per_s(at, j));
        gain += weight[k] * (std::exp(-known[k]) - std::exp(-known[k] - more));
        known[k] += more;
        all += weight[k];
      }
      Looks looks(open.size());
      looks.add(views[static_cast<std::size_t>(i)], 0.7);
      looks.add(views[static_cast<std::size_t>(j)], 0.2);
      EXPECT_NEAR(looks.answer(open), gain, 3e-4 * all) << questions << " questions";
    }
    for (Eigen::Index k = 0; k < questions; ++k) {
      const auto at = static_cast<std::size_t>(k);
      EXPECT_NEAR(open(k), weight[at] * std::exp(-known[at]), 6e-4 * weight[at]) << questions << " questions";
    }
  }
}

TEST(Prospect, GroundThatNobodyMayFlyOverIsNotWaitedFor) {
  Field field({0, 80, 0, 80});
  SearchConfig config = information_config();
  const Area closed{20, 60, 20, 60};
  config.route.fence.excluded.push_back(polygon_of(closed));
  const Outlook outlook(field, 0.0, {}, config);
  Eigen::ArrayXf live_s = Eigen::ArrayXf::Zero(outlook.prospect.per_s.cols());
  for (std::size_t i = 0; i < outlook.ground.size(); ++i) {
    const Eigen::Vector3d& p_W = outlook.ground.p_W(i);
    const bool inside = closed.contains(p_W.x(), p_W.y());
    EXPECT_EQ(outlook.prospect.flyable[i], !inside) << p_W.transpose();
    live_s(static_cast<Eigen::Index>(i)) = inside ? 0.0F : 3.0F;
  }
  const auto all_clear = [&](const SearchConfig& with) {
    const SearchState state = field.state();
    const HoverPlaces hover_W = hover_places(outlook.ground, state.world, with.route, 2.0);
    return make_prospect(outlook.ground, singles_kernels(outlook.ground, state, 2.0), state, with, live_s, hover_W)
        .all_clear;
  };
  EXPECT_TRUE(all_clear(config));
  EXPECT_FALSE(all_clear(information_config()));
}

TEST(Prospect, GroundThatNobodyMayFlyOverWeighsAsMuchLessAsItIsSeenWorse) {
  Field field({0, 80, 0, 80});
  SearchConfig config = information_config();
  config.route.fence.excluded.push_back(polygon_of({20, 60, 20, 60}));
  const Outlook closed(field, 0.0, {}, config), open(field);
  ASSERT_EQ(closed.prospect.weight.size(), open.prospect.weight.size());  // the least activity comes first
  const auto share = [&](double x_m) {
    const auto j = static_cast<Eigen::Index>(open.ground.at({x_m, 40.0, 0.0}));
    return closed.prospect.weight(j) / open.prospect.weight(j);
  };
  EXPECT_EQ(share(10.0), 1.0F);
  EXPECT_LT(share(24.0), 0.6F);
  EXPECT_LT(share(40.0), 0.01F);
  for (const double x_m : {24.0, 28.0, 32.0, 36.0}) EXPECT_GT(share(x_m), share(x_m + 4.0)) << x_m;
}

}  // namespace
}  // namespace comptonaut
