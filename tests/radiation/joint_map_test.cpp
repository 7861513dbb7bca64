// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/joint_map.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>

#include "radiation/sensitivity_error.h"
#include "radiation/slow_map.h"

namespace comptonaut {
namespace {

/// Nothing merged, no block of air holds two viewpoints, no step lengthened.
JointMapConfig exact() {
  JointMapConfig config;
  config.resolution = {.merge_rad = 1e-6, .block_m = 0.01};
  config.accelerated = false;
  return config;
}

/// Where nothing is merged, each step is the slow one.
TEST(JointMap, IsSection54WhereNothingIsMerged) {
  const JointData data = some_data(31);
  const JointConfig joint;
  const JointProblem problem{.config = joint, .physics = physics(), .data = data};
  JointMapConfig config = exact();
  config.steps_max = 5;
  JointMap map(config, field());
  map.extend(physics(), data);
  const Convergence reached = map.update(problem, some_model(data), {});
  SlowMap slow(data, some_model(data));
  double log_l = 0.0;
  for (int step = 0; step < 4; ++step) (void)slow.step();
  const std::vector<double> lambda = slow.lambda;
  const std::vector<DroneModel> drones = slow.model.drones;
  log_l = slow.step();
  EXPECT_NEAR(reached.log_likelihood, log_l, 1e-6 * std::abs(log_l));
  EXPECT_EQ(reached.steps, 5);
  EXPECT_FALSE(reached.reached);
  const std::vector<double> fast = map.lambda_Bq(), s = map.sensitivity_s();
  for (std::size_t j = 0; j < fast.size(); ++j) {
    ASSERT_NEAR(s[j], slow.s[j], 1e-9 * slow.s[j]) << "cell " << j;
    ASSERT_NEAR(fast[j], lambda[j], 1e-5 * lambda[j]) << "cell " << j;
  }
  for (std::size_t d = 0; d < drones.size(); ++d) {
    EXPECT_NEAR(map.drones()[d].singles_per_s, drones[d].singles_per_s, 1e-6 * drones[d].singles_per_s);
    EXPECT_NEAR(map.drones()[d].pairs_per_s, drones[d].pairs_per_s, 1e-6 * drones[d].pairs_per_s);
  }
}

/// With what is held fixed: sum s lambda + background = counts less those that are held, after any step of EM.
TEST(JointMap, KeepsCountsAfterEachStepAndNeverLosesLikelihood) {
  const JointData data = some_data(32);
  const JointConfig joint;
  const JointProblem problem{.config = joint, .physics = physics(), .data = data};
  JointMapConfig config;
  config.accelerated = false;
  config.steps_max = 2;
  config.floor_share = 0.0;
  JointMap map(config, field());
  map.extend(physics(), data);
  double counted = static_cast<double>(data.pairs.size()), before = -1e300;
  for (const double n : data.viewpoints.singles) counted += n;
  for (int update = 0; update < 20; ++update) {
    const Convergence reached = map.update(problem, some_model(data), {});
    EXPECT_GE(reached.log_likelihood, before) << "update " << update;
    before = reached.log_likelihood;
    const std::vector<double> lambda = map.lambda_Bq(), s = map.sensitivity_s();
    double sum = std::inner_product(s.begin(), s.end(), lambda.begin(), 0.0);
    for (std::size_t d = 0; d < data.live_s.size(); ++d) {
      sum += data.live_s[d] * (map.drones()[d].singles_per_s + map.drones()[d].pairs_per_s);
    }
    EXPECT_NEAR(sum, counted, 1e-6 * counted) << "update " << update;
  }
}

TEST(JointMap, ComesToTheSameLikelihoodFasterAccelerated) {
  const JointData data = some_data(33);
  const JointConfig joint;
  const JointProblem problem{.config = joint, .physics = physics(), .data = data};
  const auto converge = [&](bool momentum, int steps) {
    JointMapConfig config;
    config.accelerated = momentum;
    config.steps_max = steps;
    config.gain_min = 0.0;
    JointMap map(config, field());
    map.extend(physics(), data);
    return map.update(problem, some_model(data), {}).log_likelihood;
  };
  const double best = converge(false, 3000);
  EXPECT_GT(converge(true, 200), best - 0.2);
  EXPECT_LT(converge(false, 200), best - 1.0);
}

/// At the largest likelihood of all, no cell gains by more activity, and none that has some by less.
TEST(JointMap, EndsAtTheMaximumAndComesBackToItWithNewData) {
  JointData data;
  const JointConfig joint;
  const JointProblem problem{.config = joint, .physics = physics(), .data = data};
  JointMapConfig config = exact();
  config.accelerated = true;
  JointMap map(config, field());
  const ToyField toy{
      .sources = {{.p_W = {6.2, 7.3, 0.0}, .activity_Bq = 2e9}, {.p_W = {14.7, 12.1, 0.0}, .activity_Bq = 1e9}}};
  const std::vector<MeasurementBatch> batches = toy.sweep(physics(), 20.0, 3.0, 33);
  for (std::size_t i = 0; i < batches.size(); ++i) {
    add(data, batches[i], "Cs-137");
    if (i != batches.size() / 2 && i + 1 != batches.size()) continue;
    map.extend(physics(), data);
    const JointModel model = some_model(data);
    const Convergence reached = map.update(problem, model, {});
    ASSERT_TRUE(reached.reached) << reached.steps << " steps at batch " << i;
    SlowMap slow(data, model);
    slow.lambda = map.lambda_Bq();
    for (std::size_t d = 0; d < model.drones.size(); ++d) {
      slow.model.drones[d].singles_per_s = map.drones()[d].singles_per_s;
      slow.model.drones[d].pairs_per_s = map.drones()[d].pairs_per_s;
    }
    const std::vector<double> lambda = slow.lambda;
    (void)slow.step();
    double off = 0.0, counts = 0.0;
    for (std::size_t j = 0; j < lambda.size(); ++j) {
      ASSERT_LT(slow.ratio[j], 1.01) << "cell " << j << " at batch " << i;
      off += slow.s[j] * lambda[j] * std::abs(slow.ratio[j] - 1.0);
      counts += slow.s[j] * lambda[j];
    }
    EXPECT_LT(off, 2e-3 * counts) << "batch " << i;
  }
}

/// Likelihoods of maps that merge are compared with the dense one, and what they say about the sources.
TEST(JointMap, MergesFarCellsAtLittleCost) {
  const JointData data = some_data(34);
  const JointConfig joint;
  const JointProblem problem{.config = joint, .physics = physics(), .data = data};
  const auto activity = [&](const JointMapConfig& config, double x_m, double y_m) {
    JointMap map(config, field());
    map.extend(physics(), data);
    (void)map.update(problem, some_model(data), {});
    const std::vector<double> lambda = map.lambda_Bq();
    double sum = 0.0;
    for (std::size_t j = 0; j < lambda.size(); ++j) {
      if (std::hypot(field().p_W(j).x() - x_m, field().p_W(j).y() - y_m) < 2.0) sum += lambda[j];
    }
    return sum;
  };
  JointMapConfig dense = exact();
  dense.accelerated = true;
  for (const auto& [x_m, y_m] : {std::pair(6.2, 7.3), {14.7, 12.1}}) {
    const double full = activity(dense, x_m, y_m), merged = activity({}, x_m, y_m);
    EXPECT_NEAR(merged, full, 0.02 * full) << "source at " << x_m;
  }
}

/// Of a square whose corner was flown over.
SensitivityError sensitivity_error(const JointData& data, double edge_m, double merge_rad) {
  const Cells ground = flat_cells({0, edge_m, 0, edge_m}, 0.5);
  const JointConfig joint;
  const JointProblem problem{.config = joint, .physics = physics(), .data = data};
  const JointModel model = some_model(data);
  JointMapConfig config;
  config.resolution.merge_rad = merge_rad;
  config.steps_max = 1;
  JointMap map(config, ground);
  map.extend(physics(), data);
  (void)map.update(problem, model, {});
  return sensitivity_error(map, ground, physics(), data, model);
}

/// The stated error of a cell's sensitivity: where it was flown over 0.001 % rms, 0.005 % at worst; over 200 x 200 m of
/// which a corner of 20 x 20 m was flown over, so that nearly all is seen from far and from one side, 0.09 % and 0.6 %.
TEST(JointMap, KnowsTheSensitivityWithinItsStatedError) {
  const JointData data = some_data(38);
  for (const auto& [edge_m, merge_rad, rms_max, worst_max] :
       {std::array{20.0, 0.2, 2e-5, 1e-4}, {200.0, 0.2, 1e-3, 1e-2}, {200.0, 0.1, 2e-4, 2e-3}}) {
    const SensitivityError error = sensitivity_error(data, edge_m, merge_rad);
    EXPECT_LT(error.rms, rms_max) << edge_m << " m, " << merge_rad;
    EXPECT_LT(error.worst, worst_max) << edge_m << " m, " << merge_rad;
  }
}

TEST(JointMap, ShowsOnlyWhatHeldSourcesDoNotExplain) {
  const JointData data = some_data(35);
  const JointConfig joint;
  const JointProblem problem{.config = joint, .physics = physics(), .data = data};
  JointModel model = some_model(data);
  for (DroneModel& drone : model.drones) drone.scale = 1.0;
  model.sources = {{.p_W = {6.2, 7.3, 0.0}, .activity_Bq = 2e9}};
  const JointState state = state_of(problem, model);
  JointMap map({}, field());
  map.extend(physics(), data);
  (void)map.update(problem, model, sources_only(problem, model, state.columns));
  const std::vector<double> lambda = map.lambda_Bq();
  double held = 0.0, left = 0.0;
  for (std::size_t j = 0; j < lambda.size(); ++j) {
    if ((field().p_W(j) - model.sources[0].p_W).norm() < 2.0) held += lambda[j];
    if ((field().p_W(j) - Eigen::Vector3d(14.7, 12.1, 0.0)).norm() < 2.0) left += lambda[j];
  }
  EXPECT_LT(held, 0.03 * 2e9);
  EXPECT_NEAR(left, 1e9, 0.2 * 1e9);  // the rest is haze around it
}

TEST(JointMap, IsTheSameHoweverTheDataCame) {
  const JointData data = some_data(36);
  const JointConfig joint;
  JointMap at_once({}, field()), in_parts({}, field());
  at_once.extend(physics(), data);
  const ToyField toy{
      .sources = {{.p_W = {6.2, 7.3, 0.0}, .activity_Bq = 2e9}, {.p_W = {14.7, 12.1, 0.0}, .activity_Bq = 1e9}}};
  JointData part;
  for (const MeasurementBatch& batch : toy.sweep(physics(), 20.0, 3.0, 36)) {
    add(part, batch, "Cs-137");
    in_parts.extend(physics(), part);
  }
  const JointProblem problem{.config = joint, .physics = physics(), .data = data};
  const Convergence a = at_once.update(problem, some_model(data), {}),
                    b = in_parts.update(problem, some_model(data), {});
  EXPECT_NEAR(a.log_likelihood, b.log_likelihood, 0.05);
}

/// Rows that are older than a turn: projected anew when it is large, kept when it is small.
TEST(JointMap, FollowsTheTurnsOfDetectors) {
  const JointConfig joint;
  const Eigen::Vector3d axis = Eigen::Vector3d(1.0, -2.0, 2.0) / 3.0;
  for (const double turn_rad : {0.9 * MapRows::kTurnKept_rad, 1.1 * MapRows::kTurnKept_rad, 0.0175}) {
    JointData data = some_data(39);
    JointMap map({}, field()), fresh({}, field());
    map.extend(physics(), data);
    turn(data, {turn_rad * axis, -turn_rad * axis});
    const JointProblem problem{.config = joint, .physics = physics(), .data = data};
    map.extend(physics(), data);
    fresh.extend(physics(), data);
    (void)map.update(problem, some_model(data), {});
    (void)fresh.update(problem, some_model(data), {});
    const std::vector<double> lambda = map.lambda_Bq(), exact = fresh.lambda_Bq(), s = map.sensitivity_s(),
                              exact_s = fresh.sensitivity_s();
    const bool kept = turn_rad < MapRows::kTurnKept_rad;
    double off_Bq = 0.0, sum_Bq = 0.0;
    for (std::size_t j = 0; j < s.size(); ++j) {
      ASSERT_NEAR(s[j], exact_s[j], (kept ? 2e-3 : 1e-12) * exact_s[j]) << "turn " << turn_rad << ", cell " << j;
      off_Bq += 0.5 * std::abs(lambda[j] - exact[j]);
      sum_Bq += exact[j];
    }
    EXPECT_LE(off_Bq, (kept ? 0.05 : 1e-9) * sum_Bq) << "turn " << turn_rad;
  }
}

TEST(JointMap, HasAnAnswerWithoutData) {
  const JointData data;
  const JointConfig joint;
  const JointProblem problem{.config = joint, .physics = physics(), .data = data};
  JointMap map({}, field());
  map.extend(physics(), data);
  const Convergence reached = map.update(problem, {}, {});
  EXPECT_TRUE(reached.reached);
  for (const double lambda : map.lambda_Bq()) EXPECT_EQ(lambda, 0.0);
}

}  // namespace
}  // namespace comptonaut
