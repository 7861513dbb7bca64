// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/patches.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "radiation/joint_estimator.h"
#include "radiation/joint_world.h"

namespace comptonaut {
namespace {

const Cells& field() {
  static const Cells cells = flat_cells({0, 30, 0, 30}, 0.5);
  return cells;
}

JointEstimator fed(const std::vector<PointSource>& sources, std::uint64_t seed) {
  JointEstimator estimator({}, field(), "Cs-137", toy_table(), toy_cones());
  const auto batches = ToyField{.sources = sources}.sweep(toy_physics(), 30.0, 2.0, seed);
  for (std::size_t i = 0; i < batches.size(); ++i) {
    estimator.add(batches[i]);
    if (i % 100 == 99) estimator.update();
  }
  for (int i = 0; i < 5; ++i) estimator.update();
  return estimator;
}

/// Points so close together that no detector can tell them.
std::vector<PointSource> disc(double x_m, double y_m, double radius_m, double activity_Bq) {
  constexpr int kPoints = 200;
  std::vector<PointSource> points;
  for (int i = 0; i < kPoints; ++i) {
    const double r_m = radius_m * std::sqrt((i + 0.5) / kPoints), turn_rad = 2.399963 * i;
    points.push_back({.p_W = {x_m + r_m * std::cos(turn_rad), y_m + r_m * std::sin(turn_rad), 0.0},
                      .activity_Bq = activity_Bq / kPoints});
  }
  return points;
}

TEST(Patches, TellsWhatIsSpreadFromPoints) {
  std::vector<PointSource> truth = disc(20.0, 18.0, 4.0, 4e9);
  truth.push_back({.p_W = {6.3, 7.1, 0.0}, .activity_Bq = 1e9});
  const JointEstimator estimator = fed(truth, 91);
  ASSERT_EQ(estimator.patches().size(), 1U);
  const PatchEstimate& patch = estimator.patches().front();
  EXPECT_LT((patch.p_W - Eigen::Vector3d(20.0, 18.0, 0.0)).norm(), 1.0);
  EXPECT_NEAR(patch.area_m2, 16.0 * std::numbers::pi, 0.15 * 16.0 * std::numbers::pi);
  EXPECT_NEAR(patch.activity_Bq, 4e9, 0.15 * 4e9);
  const std::vector<double> lambda = estimator.ground_map().lambda_Bq();
  double on_patch_Bq = 0.0;
  for (std::size_t j = 0; j < lambda.size(); ++j) {
    if ((field().p_W(j) - Eigen::Vector3d(20.0, 18.0, 0.0)).norm() < 5.0) on_patch_Bq += lambda[j];
  }
  EXPECT_NEAR(on_patch_Bq, 4e9, 0.15 * 4e9) << "the map shows it";
  ASSERT_EQ(estimator.sources().size(), 1U) << "the patch is no list of points";
  EXPECT_LT((estimator.sources().front().p_W - truth.back().p_W).norm(), 0.3);
}

TEST(Patches, LeavesPointsAlone) {
  const std::vector<PointSource> truth = {{.p_W = {12.0, 12.0, 0.0}, .activity_Bq = 2e9},
                                          {.p_W = {16.5, 12.0, 0.0}, .activity_Bq = 1e9},
                                          {.p_W = {14.0, 16.5, 0.0}, .activity_Bq = 1e9}};
  const JointEstimator estimator = fed(truth, 92);
  EXPECT_TRUE(estimator.patches().empty());
  EXPECT_EQ(estimator.sources().size(), 3U);
}

TEST(Patches, ADiscIsTheMeanOfItsPoints) {
  const JointPhysics physics = toy_physics();
  const JointConfig config;
  const JointData data = data_of(ToyField{.sources = {{{5, 5, 0}, 1e9}}}.sweep(physics, 20.0, 4.0, 93));
  const JointProblem problem{.config = config, .physics = physics, .data = data};
  const Ground ground{.area = {0, 20, 0, 20}, .z_m = [](double, double) { return 0.0; }};
  const ResponseColumn fast = disc_column(problem, ground, {10, 10, 0}, 3.0);
  std::vector<double> slow(fast.singles.size(), 0.0);
  for (const PointSource& point : disc(10, 10, 3.0, 1.0)) {
    ResponseColumn column;
    fill_column(physics, data, point.p_W, column);
    for (std::size_t i = 0; i < slow.size(); ++i) slow[i] += point.activity_Bq * column.singles[i];
  }
  for (std::size_t i = 0; i < slow.size(); ++i) EXPECT_NEAR(fast.singles[i], slow[i], 0.08 * slow[i]) << i;
}

}  // namespace
}  // namespace comptonaut
