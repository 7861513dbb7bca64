// SPDX-License-Identifier: BSD-3-Clause
// Where ScoreMap says that the ground is clear.
#include <gtest/gtest.h>

#include <cmath>

#include "radiation/joint_world.h"
#include "radiation/score_map.h"
#include "radiation/upper_limit.h"

namespace comptonaut {
namespace {

constexpr double kChance = 0.05;

const JointPhysics& physics() {
  static const JointPhysics shared = toy_physics();
  return shared;
}

JointModel model_of(const JointData& data, std::vector<PointSource> sources) {
  JointModel model{.sources = std::move(sources)};
  for (std::size_t d = 0; d < data.senders.size(); ++d) {
    model.drones.push_back({.singles_per_s = 3.0, .pairs_per_s = 0.02, .scale = 1.0 + 0.05 * d});
  }
  return model;
}

/// Every viewpoint by itself, every term as it is.
double slow_limit(const JointProblem& problem, const JointState& state, const Eigen::Vector3d& p_W) {
  const Viewpoints& v = problem.data.viewpoints;
  const Expected sums = expected(problem, state.model, state.columns);
  ResponseColumn column;
  fill_column(problem.physics, problem.data, p_W, column);
  ActivityEvidence e;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const double per_Bq = state.model.drones[v.drone[i]].scale * state.model.scatter * column.singles[i];
    e.sensitivity_s += per_Bq;
    if (v.singles[i] == 0.0) continue;
    e.ratios_per_Bq.push_back(per_Bq / sums.singles[i]);
    e.counts.push_back(v.singles[i]);
  }
  for (std::size_t i = 0; i < column.pairs.size(); ++i) {
    const double scale = state.model.drones[problem.data.pairs[i].drone].scale;
    e.ratios_per_Bq.push_back(scale * column.pairs[i] / sums.pairs[i]);
    e.counts.push_back(1.0);
  }
  for (std::size_t d = 0; d < column.exposure_s.size(); ++d) {
    e.sensitivity_s += state.model.drones[d].scale * column.exposure_s[d];
  }
  return upper_limit_Bq(e, kChance);
}

TEST(Clearance, IsThatOfTheWholeLikelihood) {
  const std::vector<PointSource> sources = {{.p_W = {6.2, 7.3, 0.0}, .activity_Bq = 2e9}};
  const JointData data = data_of(ToyField{.sources = sources}.sweep(physics(), 20.0, 3.0, 81));
  const JointConfig config;
  const JointProblem problem{.config = config, .physics = physics(), .data = data};
  const JointState state = state_of(problem, model_of(data, sources));
  ScoreMap map(flat_cells({0, 20, 0, 20}, 0.5), config.score_spacing_m);
  map.extend(problem);
  const std::vector<double> limits_Bq = map.clear_above_Bq(problem, state, kChance);
  ASSERT_EQ(limits_Bq.size(), map.places().size());
  double squares = 0.0;
  for (std::size_t j = 0; j < limits_Bq.size(); j += 7) {
    const double slow_Bq = slow_limit(problem, state, map.places().p_W(j));
    EXPECT_NEAR(limits_Bq[j], slow_Bq, 0.5 * slow_Bq) << "place " << j;  // blocks of air are taken as one
    squares += std::pow(std::log(limits_Bq[j] / slow_Bq), 2);
  }
  EXPECT_LT(std::sqrt(squares / (limits_Bq.size() / 7.0)), 0.12);
}

TEST(Clearance, GrowsWithDistanceFromWhatWasSeenAndIsNothingWithoutData) {
  const JointConfig config;
  const JointData data = data_of(ToyField{}.sweep(physics(), 10.0, 2.0, 82)), none;
  ScoreMap map(flat_cells({0, 40, 0, 40}, 0.5), config.score_spacing_m), blank = map;
  const JointProblem problem{.config = config, .physics = physics(), .data = data};
  map.extend(problem);
  const std::vector<double> limits_Bq = map.clear_above_Bq(problem, state_of(problem, model_of(data, {})), kChance);
  const auto at = [&](double x_m, double y_m) { return limits_Bq[*map.places().find(voxel_at({x_m, y_m, 0}, 1.0))]; };
  EXPECT_LT(at(5.5, 5.5), 1e8);
  EXPECT_GT(at(38.5, 38.5), 20.0 * at(5.5, 5.5));
  const JointProblem nothing{.config = config, .physics = physics(), .data = none};
  blank.extend(nothing);
  for (const double limit_Bq : blank.clear_above_Bq(nothing, state_of(nothing, {}), kChance)) {
    ASSERT_TRUE(std::isinf(limit_Bq));
  }
}

/// A source too weak to be told stays below the limit of its place in about 19 of 20 missions or more.
TEST(Clearance, HoldsWeakSourcesNineteenTimesOfTwenty) {
  const JointConfig config;
  const Cells cells = flat_cells({0, 8, 0, 8}, 0.5);
  for (const double source_Bq : {1e7, 3e7, 1e8}) {
    constexpr int kMissions = 400;
    int held = 0;
    for (int mission = 0; mission < kMissions; ++mission) {
      const PointSource source{.p_W = {4.5, 3.5, 0.0}, .activity_Bq = source_Bq};
      const JointData data = data_of(ToyField{.sources = {source}}.sweep(physics(), 8.0, 2.0, 900 + mission));
      const JointProblem problem{.config = config, .physics = physics(), .data = data};
      JointModel model = model_of(data, {});
      for (DroneModel& drone : model.drones) drone.scale = 1.0;
      ScoreMap map(cells, config.score_spacing_m);
      map.extend(problem);
      const std::vector<double> limits_Bq = map.clear_above_Bq(problem, state_of(problem, model), kChance);
      held += limits_Bq[*map.places().find(voxel_at(source.p_W, 1.0))] > source_Bq ? 1 : 0;
    }
    EXPECT_GE(held, 0.92 * kMissions) << source_Bq;
  }
}

}  // namespace
}  // namespace comptonaut
