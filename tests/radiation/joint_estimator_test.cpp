// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/joint_estimator.h"

#include <gtest/gtest.h>

#include <cmath>

#include "radiation/cramer_rao.h"
#include "radiation/hiding_chance.h"
#include "radiation/joint_world.h"
#include "radiation/metrics.h"
#include "radiation/source_heights.h"

namespace comptonaut {
namespace {

const Cells& toy_cells() {
  static const Cells cells = flat_cells({0, 30, 0, 30}, 0.5);
  return cells;
}

JointEstimator toy_estimator(const JointConfig& config = {}) {
  return {config, toy_cells(), "Cs-137", toy_table(), toy_cones()};
}

const std::vector<PointSource> kThree = {{.p_W = {7.3, 8.1, 0}, .activity_Bq = 2e9},
                                         {.p_W = {21.9, 6.6, 0}, .activity_Bq = 1e9},
                                         {.p_W = {14.2, 23.4, 0}, .activity_Bq = 0.3e9}};

/// Updates on the way, as a coordinator does.
void feed(const std::vector<MeasurementBatch>& batches, JointEstimator& estimator) {
  for (std::size_t i = 0; i < batches.size(); ++i) {
    estimator.add(batches[i]);
    if (i % 60 == 59) estimator.update();
  }
  estimator.update();
}

TEST(JointEstimator, FindsHowManyWhereAndHowStrong) {
  const ToyField field{.sources = kThree};
  JointEstimator estimator = toy_estimator();
  feed(field.sweep(toy_physics(), 30.0, 2.0, 11), estimator);
  ASSERT_EQ(estimator.sources().size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) {
    const SourceEstimate& source = estimator.sources()[k];
    EXPECT_LE((source.p_W - kThree[k].p_W).norm(), 1.0) << k;
    EXPECT_NEAR((source.activity_Bq - kThree[k].activity_Bq) / source.activity_sigma_Bq, 0.0, 3.0) << k;
    EXPECT_NEAR((source.p_W.x() - kThree[k].p_W.x()) / source.position_sigma_m.x(), 0.0, 3.5) << k;
    EXPECT_NEAR((source.p_W.y() - kThree[k].p_W.y()) / source.position_sigma_m.y(), 0.0, 3.5) << k;
    EXPECT_GT(source.significance, 18.0) << k;
  }
}

/// Sources and map agree: what the sources explain is not shown twice.
TEST(JointEstimator, MapsWhatItsSourcesDoNotExplain) {
  const auto batches = ToyField{.sources = kThree}.sweep(toy_physics(), 30.0, 2.0, 13);
  constexpr int kSteps = 8;  // of 19 updates: a mission has ten times as many
  JointEstimator with_sources = toy_estimator({.map_steps = kSteps}),
                 map_alone = toy_estimator({.gain_to_add = 1e6, .map_steps = kSteps});
  for (JointEstimator* estimator : {&with_sources, &map_alone}) {
    feed(batches, *estimator);
    EXPECT_LE(estimator->map_convergence().steps, kSteps);
    EXPECT_LT(estimator->map_convergence().gain, 0.5);
  }
  const auto near_sources = [](const JointEstimator& estimator) {
    const std::vector<double> lambda = estimator.ground_map().lambda_Bq();
    double sum_Bq = 0.0;
    for (std::size_t j = 0; j < lambda.size(); ++j) {
      for (const PointSource& source : kThree) {
        if ((source.p_W - toy_cells().p_W(j)).norm() < 2.0) sum_Bq += lambda[j];
      }
    }
    return sum_Bq;
  };
  EXPECT_EQ(with_sources.sources().size(), 3U);
  EXPECT_TRUE(map_alone.sources().empty());
  EXPECT_NEAR(near_sources(map_alone), 3.3e9, 0.1 * 3.3e9);
  EXPECT_LT(near_sources(with_sources), 0.03 * 3.3e9);
}

TEST(JointEstimator, FindsThemFromPairsOrSinglesAlone) {
  const auto batches = ToyField{.sources = kThree}.sweep(toy_physics(), 30.0, 2.0, 12);
  for (const bool pairs : {true, false}) {
    JointEstimator estimator = toy_estimator({.use_pairs = pairs, .use_singles = !pairs});
    feed(batches, estimator);
    for (std::size_t k = 0; k < 2; ++k) {
      ASSERT_GT(estimator.sources().size(), k) << pairs;
      EXPECT_LE((estimator.sources()[k].p_W - kThree[k].p_W).norm(), pairs ? 1.0 : 0.3) << pairs << k;
    }
    EXPECT_LE(estimator.sources().size(), 3U) << pairs;
  }
}

TEST(JointEstimator, LooksHoldWhatWasCountedBesideWhatTheSourcesExplain) {
  const auto batches = ToyField{.sources = kThree}.sweep(toy_physics(), 30.0, 2.0, 10);
  JointEstimator estimator = toy_estimator();
  feed(batches, estimator);
  const std::vector<Look> looks = estimator.looks();
  ASSERT_EQ(looks.size(), batches.size());
  double counted = 0.0, expected = 0.0, largest = 0.0, at_largest = 0.0;
  for (std::size_t i = 0; i < looks.size(); ++i) {
    EXPECT_EQ(looks[i].p_WD, batches[i].p_WD);
    EXPECT_EQ(looks[i].live_s, seconds(batches[i].live_us));
    EXPECT_EQ(looks[i].singles, static_cast<double>(batches[i].channels.front().singles));
    counted += looks[i].singles;
    expected += looks[i].expected;
    if (looks[i].expected > largest) largest = looks[i].expected, at_largest = looks[i].singles;
  }
  EXPECT_NEAR(expected, counted, 3.0 * std::sqrt(counted));
  EXPECT_NEAR(at_largest, largest, 5.0 * std::sqrt(largest));
}

TEST(JointEstimator, CoversWhatItHasSeen) {
  EXPECT_EQ(hiding_chance(0.0, 1e8, 1e10), 1.0);
  EXPECT_NEAR(hiding_chance(1e-12, 1e8, 1e10), 1.0, 0.01);
  EXPECT_NEAR(hiding_chance(1e-9, 1e8, 1e10), 0.396, 0.001);  // [E1(0.1) - E1(10)] / ln 100
  EXPECT_LT(hiding_chance(1e-7, 1e8, 1e10), 1e-5);
  JointEstimator estimator = toy_estimator();
  EXPECT_EQ(estimator.coverage(), 0.0);
  double before = 0.0;
  const auto batches = ToyField{.sources = kThree}.sweep(toy_physics(), 30.0, 4.0, 18);
  for (std::size_t i = 0; i < batches.size(); ++i) {
    estimator.add(batches[i]);
    if (i % 100 != 99) continue;
    estimator.update();
    EXPECT_GE(estimator.coverage(), before - 0.05) << i;
    before = estimator.coverage();
  }
  EXPECT_GT(before, 0.9);
}

TEST(JointEstimator, SeesNothingWhereNothingIs) {
  JointEstimator estimator = toy_estimator();
  estimator.update();
  EXPECT_TRUE(estimator.sources().empty());
  feed(ToyField{}.sweep(toy_physics(), 30.0, 3.0, 13), estimator);
  EXPECT_TRUE(estimator.sources().empty());
  ASSERT_EQ(estimator.model().drones.size(), 2U);
  EXPECT_NEAR(estimator.model().drones[0].singles_per_s, 3.0, 0.7);
}

TEST(JointEstimator, SeparatesTwoSourcesTwoMetresApart) {
  const ToyField field{
      .sources = {{.p_W = {10, 10, 0}, .activity_Bq = 2e9}, {.p_W = {12, 10.5, 0}, .activity_Bq = 1.5e9}}};
  JointEstimator estimator = toy_estimator();
  feed(field.sweep(toy_physics(), 30.0, 1.5, 14), estimator);
  ASSERT_EQ(estimator.sources().size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_LE((estimator.sources()[k].p_W - field.sources[k].p_W).norm(), 0.4) << k;
  }
}

TEST(JointEstimator, LiftsWhatStandsAboveTheGroundAndNothingElse) {
  std::vector<PointSource> truth = kThree;
  truth[1].p_W.z() = 1.0;
  JointEstimator estimator = toy_estimator();
  feed(ToyField{.sources = truth}.sweep(toy_physics(), 30.0, 2.0, 21), estimator);
  ASSERT_EQ(estimator.sources().size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) {
    const SourceEstimate& source = estimator.sources()[k];
    if (k == 1) {
      EXPECT_NEAR((source.p_W.z() - 1.0) / source.position_sigma_m.z(), 0.0, 3.0);
      EXPECT_LT(source.position_sigma_m.z(), 0.3);
    } else {
      EXPECT_EQ(source.p_W.z(), estimator.sources()[0].p_W.z()) << k;
      EXPECT_EQ(source.position_sigma_m.z(), 0.0) << k;
    }
    EXPECT_NEAR((source.activity_Bq - truth[k].activity_Bq) / source.activity_sigma_Bq, 0.0, 3.0) << k;
  }
}

TEST(JointEstimator, PutsASourceBackThatNoLongerNeedsItsHeight) {
  const JointConfig config;
  const JointPhysics physics = toy_physics();
  const Ground ground{.area = {0, 30, 0, 30}, .height_max_m = 1.5, .z_m = [](double, double) { return 0.0; }};
  const JointData data = data_of(ToyField{.sources = kThree}.sweep(physics, 30.0, 2.0, 11));
  const JointProblem problem{.config = config, .physics = physics, .data = data};
  JointModel model{.sources = kThree, .drones = std::vector<DroneModel>(2)};
  model.sources[0].p_W.z() = 0.3;
  JointState state = state_of(problem, model);
  refit(problem, ground, all_of(3), 30, 1e-4, state);
  EXPECT_TRUE(adjust_heights(problem, ground, state));
  for (const PointSource& source : state.model.sources) EXPECT_EQ(source.p_W.z(), 0.0);
  EXPECT_FALSE(adjust_heights(problem, ground, state));
}

TEST(JointEstimator, GivesTheSameBitsForTheSameBatches) {
  const auto batches = ToyField{.sources = kThree}.sweep(toy_physics(), 30.0, 4.0, 15);
  JointEstimator a = toy_estimator(), b = toy_estimator();
  feed(batches, a);
  feed(batches, b);
  EXPECT_EQ(a.log_likelihood(), b.log_likelihood());
  ASSERT_EQ(a.sources().size(), b.sources().size());
  for (std::size_t k = 0; k < a.sources().size(); ++k) {
    EXPECT_EQ(a.sources()[k].p_W, b.sources()[k].p_W);
    EXPECT_EQ(a.sources()[k].activity_Bq, b.sources()[k].activity_Bq);
  }
}

/// Over some fields: no unbiased estimate is better than the bound, and ours is near it.
TEST(CramerRao, IsWhatTheEstimatorReaches) {
  const JointPhysics physics = toy_physics();
  const JointConfig config{.scatter_share = 0.2};
  double squares_m2 = 0.0, bounds_m2 = 0.0;
  for (std::uint64_t seed = 30; seed < 42; ++seed) {
    const ToyField field{.sources = {{.p_W = {6, 7, 0}, .activity_Bq = 1e9}, {.p_W = {14, 12, 0}, .activity_Bq = 1e9}}};
    CramerRao bound({{"Cs-137", config, physics}}, field.sources, {1, 2});
    const Cells cells = flat_cells({0, 20, 0, 20}, 0.5);
    JointEstimator estimator(config, cells, "Cs-137", toy_table(), toy_cones());
    for (const MeasurementBatch& batch : field.sweep(physics, 20.0, 2.0, seed)) {
      bound.add(batch);
      estimator.add(batch);
    }
    estimator.update();
    ASSERT_EQ(estimator.sources().size(), 2U) << seed;
    std::vector<PointSource> found;
    for (const SourceEstimate& source : estimator.sources()) found.push_back({source.p_W, source.activity_Bq});
    squares_m2 += std::pow(localise(field.sources, found, 28.0).rmse_m, 2);
    bounds_m2 += std::pow(bound.rmse_m(), 2);
  }
  EXPECT_NEAR(std::sqrt(squares_m2 / bounds_m2), 1.0, 0.35);
}

TEST(CramerRao, IsTheSameWheneverItIsAskedFor) {
  const JointPhysics physics = toy_physics();
  const ToyField field{.sources = {{.p_W = {6, 7, 0}, .activity_Bq = 1e9}}};
  const std::vector<JointChannel> channels = {{"Cs-137", {}, physics}};
  CramerRao once(channels, field.sources, {1, 2}), often(channels, field.sources, {1, 2});
  double before_m = 1e9;
  for (const MeasurementBatch& batch : field.sweep(physics, 12.0, 2.0, 9)) {
    once.add(batch);
    often.add(batch);
    EXPECT_LE(often.rmse_m(), before_m * (1.0 + 1e-9)) << "data never take information away";
    before_m = often.rmse_m();
  }
  EXPECT_NEAR(once.rmse_m() / before_m, 1.0, 1e-9);
}

/// Wrong sets of sources on the data of one: what they must become.
TEST(PointSources, MergeWhatIsOneAndDropWhatIsNone) {
  const JointConfig config;
  const JointPhysics physics = toy_physics();
  const ToyField field{.sources = {{.p_W = {12, 13, 0}, .activity_Bq = 2e9}}};
  const JointData data = data_of(field.sweep(physics, 25.0, 2.0, 16));
  const JointProblem problem{.config = config, .physics = physics, .data = data};
  ScoreMap map(flat_cells({0, 25, 0, 25}, 0.5), 1.0);
  map.extend(problem);
  const Ground flat{.area = {0, 25, 0, 25}, .z_m = [](double, double) { return 0.0; }};
  const std::vector<std::vector<PointSource>> wrong = {
      {{.p_W = {11.2, 12.6, 0}, .activity_Bq = 1e9}, {.p_W = {12.7, 13.3, 0}, .activity_Bq = 1e9}},
      {{.p_W = {12, 13, 0}, .activity_Bq = 2e9}, {.p_W = {20, 4, 0}, .activity_Bq = 1e8}},
      {{.p_W = {20, 4, 0}, .activity_Bq = 1e8}}};
  for (const auto& sources : wrong) {
    JointModel model{.sources = sources, .drones = std::vector<DroneModel>(2), .scatter = 1.2};
    JointState state = state_of(problem, model);
    improve(problem, flat, map, 0, state);
    ASSERT_EQ(state.model.sources.size(), 1U) << sources.size();
    EXPECT_LE((state.model.sources[0].p_W - field.sources[0].p_W).norm(), 0.2);
  }
}

}  // namespace
}  // namespace comptonaut
