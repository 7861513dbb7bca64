// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/joint_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "radiation/joint_world.h"
#include "radiation/score_map.h"

namespace comptonaut {
namespace {

const Ground kFlat{.area = {0, 20, 0, 20}, .z_m = [](double, double) { return 0.0; }};

/// Two sources, swept; and a model that is not at the optimum.
class JointLikelihood : public ::testing::Test {
 protected:
  JointLikelihood() {
    model.sources = {{.p_W = {5.3, 6.2, 0}, .activity_Bq = 1.5e9}, {.p_W = {14.6, 13.0, 0}, .activity_Bq = 0.8e9}};
    model.drones = {{.singles_per_s = 2.0, .pairs_per_s = 0.2, .scale = 0.97},
                    {.singles_per_s = 4.0, .pairs_per_s = 0.1, .scale = 1.02}};
    model.scatter = 1.15;
  }
  [[nodiscard]] JointProblem problem() const { return {.config = config, .physics = physics, .data = data}; }

  JointConfig config;
  JointPhysics physics = toy_physics();
  ToyField field{.sources = {{.p_W = {5, 6, 0}, .activity_Bq = 2e9}, {.p_W = {15, 13, 0}, .activity_Bq = 1e9}}};
  JointData data = data_of(field.sweep(physics, 20.0, 2.0, 7));
  JointModel model;
};

/// Viewpoints 0.01 drift_s apart, for three of these.
void spread_over_time(const JointConfig& config, JointData& data) {
  for (std::size_t v = 0; v < data.viewpoints.size(); ++v) {
    data.viewpoints.utime[v] = 5 * kSecond_us + microseconds(0.01 * static_cast<double>(v) * config.drift_s);
  }
}

/// 0 at 0, drift[j] at j + 1, straight between, constant after.
double slow_drift(const std::vector<double>& drift, double t) {
  double value = 0.0;
  for (std::size_t j = 0; j < drift.size(); ++j) {
    const double step = drift[j] - (j > 0 ? drift[j - 1] : 0.0), begin = static_cast<double>(j);
    value += step * std::min(1.0, std::max(0.0, t - begin));
  }
  return value;
}

/// Section 5.4, word for word, from columns.
double slow_log_likelihood(const JointProblem& p, const JointModel& m) {
  const JointState state = state_of(p, m);
  double sum = -0.5 * std::pow((m.scatter - 1.24) / 0.05, 2);
  for (const DroneModel& drone : m.drones) {
    sum -= 0.5 * std::pow((drone.scale - 1.0) / 0.03, 2);
    for (std::size_t j = 0; j < drone.drift.size(); ++j) {
      sum -= 0.5 * std::pow((drone.drift[j] - (j > 0 ? drone.drift[j - 1] : 0.0)) / p.config.drift_sigma, 2);
    }
  }
  for (std::size_t v = 0; p.config.use_singles && v < p.data.viewpoints.size(); ++v) {
    const DroneModel& drone = m.drones[p.data.viewpoints.drone[v]];
    double mu = drone.singles_per_s * p.data.viewpoints.live_s[v];
    if (!drone.drift.empty()) mu *= std::exp(slow_drift(drone.drift, 0.01 * static_cast<double>(v)));
    for (std::size_t k = 0; k < m.sources.size(); ++k) {
      mu += drone.scale * m.scatter * m.sources[k].activity_Bq * state.columns[k].singles[v];
    }
    sum += p.data.viewpoints.singles[v] * std::log(mu) - mu;
  }
  for (std::size_t i = 0; p.config.use_pairs && i < p.data.pairs.size(); ++i) {
    const DroneModel& drone = m.drones[p.data.pairs[i].drone];
    double f = drone.pairs_per_s / (4.0 * M_PI);
    for (std::size_t k = 0; k < m.sources.size(); ++k) {
      f += drone.scale * m.sources[k].activity_Bq * state.columns[k].pairs[i];
    }
    sum += std::log(f);
  }
  for (std::size_t d = 0; p.config.use_pairs && d < m.drones.size(); ++d) {
    sum -= m.drones[d].pairs_per_s * p.data.live_s[d];
    for (std::size_t k = 0; k < m.sources.size(); ++k) {
      sum -= m.drones[d].scale * m.sources[k].activity_Bq * state.columns[k].exposure_s[d];
    }
  }
  return sum;
}

TEST_F(JointLikelihood, IsSection54) {
  for (const auto& [pairs, singles] : {std::pair(true, true), {true, false}, {false, true}}) {
    config.use_pairs = pairs;
    config.use_singles = singles;
    EXPECT_NEAR(state_of(problem(), model).log_likelihood, slow_log_likelihood(problem(), model), 1e-6)
        << pairs << singles;
  }
}

TEST_F(JointLikelihood, ItsGradientIsThatOfFiniteDifferences) {
  const ParameterLayout layout{.sources = 2, .drones = 2, .movable = {0, 1}};
  const Linearisation at = linearise(problem(), state_of(problem(), model), layout);
  const auto slope = [&](auto change) {
    JointModel up = model, down = model;
    change(up, 1e-4);
    change(down, -1e-4);
    return (slow_log_likelihood(problem(), up) - slow_log_likelihood(problem(), down)) / 2e-4;
  };
  const auto expect = [&](std::size_t parameter, double slow) {
    EXPECT_NEAR(at.gradient[parameter], slow, 2e-3 * std::abs(slow) + 0.05) << "parameter " << parameter;
  };
  for (std::size_t k = 0; k < 2; ++k) {
    expect(layout.log_activity(k), slope([&](JointModel& m, double h) { m.sources[k].activity_Bq *= std::exp(h); }));
    expect(layout.x_m(k), slope([&](JointModel& m, double h) { m.sources[k].p_W.x() += h; }));
    expect(layout.x_m(k) + 1, slope([&](JointModel& m, double h) { m.sources[k].p_W.y() += h; }));
    expect(layout.log_singles(k), slope([&](JointModel& m, double h) { m.drones[k].singles_per_s *= std::exp(h); }));
    expect(layout.log_pairs(k), slope([&](JointModel& m, double h) { m.drones[k].pairs_per_s *= std::exp(h); }));
    expect(layout.scale(k), slope([&](JointModel& m, double h) { m.drones[k].scale += h; }));
  }
  expect(layout.scatter(), slope([&](JointModel& m, double h) { m.scatter += h; }));
}

TEST_F(JointLikelihood, ItsGradientByDriftAndHeightIsThatOfFiniteDifferences) {
  spread_over_time(config, data);
  ASSERT_EQ(drift_points(problem()), 5U) << "500 viewpoints";
  model.drones[0].drift = {0.2, -0.1, 0.3, 0.0, 0.1};
  model.drones[1].drift = {-0.3, 0.4, 0.1, 0.2, -0.2};
  model.sources[1].p_W.z() = 0.6;
  const Ground ground{.area = kFlat.area, .height_max_m = 1.5, .z_m = kFlat.z_m};
  const ParameterLayout layout = layout_of(ground, model, {0, 1});
  ASSERT_EQ(layout.lifted, std::vector<std::size_t>{1}) << "source 0 stands on the ground";
  EXPECT_NEAR(state_of(problem(), model).log_likelihood, slow_log_likelihood(problem(), model), 1e-6);
  const Linearisation at = linearise(problem(), state_of(problem(), model), layout);
  const auto expect = [&](std::size_t parameter, auto change) {
    JointModel up = model, down = model;
    change(up, 1e-4);
    change(down, -1e-4);
    const double slow = (slow_log_likelihood(problem(), up) - slow_log_likelihood(problem(), down)) / 2e-4;
    EXPECT_NEAR(at.gradient[parameter], slow, 2e-3 * std::abs(slow) + 0.05) << "parameter " << parameter;
  };
  expect(layout.z_m(0), [](JointModel& m, double h) { m.sources[1].p_W.z() += h; });
  for (std::size_t d = 0; d < 2; ++d) {
    for (std::size_t j = 0; j < 5; ++j)
      expect(layout.drift(d, j), [&](JointModel& m, double h) { m.drones[d].drift[j] += h; });
  }
}

TEST_F(JointLikelihood, FollowsABackgroundThatDrifts) {
  spread_over_time(config, data);
  Random random(5);
  for (std::size_t v = 0; v < data.viewpoints.size(); ++v) {  // from 3 / s to 63 / s over the mission
    const double share = static_cast<double>(v) / static_cast<double>(data.viewpoints.size());
    data.viewpoints.singles[v] += static_cast<double>(random.poisson(60.0 * share * data.viewpoints.live_s[v]));
  }
  JointState steady = state_of(problem(), model);
  for (DroneModel& drone : model.drones) drone.drift.assign(drift_points(problem()), 0.0);
  JointState drifting = state_of(problem(), model);
  refit(problem(), kFlat, {}, 200, 1e-6, steady);
  refit(problem(), kFlat, {}, 200, 1e-6, drifting);
  EXPECT_GT(drifting.log_likelihood, steady.log_likelihood + 5.0);
  const std::size_t last = data.viewpoints.size() - 1;
  EXPECT_NEAR(background(problem(), drifting.model, last) / data.viewpoints.live_s[last], 63.0, 12.0);
}

TEST_F(JointLikelihood, BelievesInAWiderSpreadOfScalesWhereDronesDisagree) {
  EXPECT_NEAR(response_spread(config, {.drones = {{.scale = 1.2}, {.scale = 1.2}}}), 0.03, 1e-12)
      << "what all have in common the data cannot tell";
  const JointModel apart{.drones = {{.scale = 0.9}, {.scale = 1.0}, {.scale = 1.1}}};
  EXPECT_NEAR(response_spread(config, apart), std::sqrt((0.03 * 0.03 + 0.02) / 2.0), 1e-12);
  const double narrow = state_of(problem(), model).log_likelihood;
  model.response_spread = 0.1;
  const double off = 0.5 * (0.03 * 0.03 + 0.02 * 0.02);
  EXPECT_NEAR(state_of(problem(), model).log_likelihood - narrow, off / (0.03 * 0.03) - off / (0.1 * 0.1), 1e-6);
}

TEST_F(JointLikelihood, ItsGradientByATurnIsThatOfFiniteDifferences) {
  const ParameterLayout layout{.sources = 2, .drones = 2, .movable = {0, 1}, .align = true};
  model.drones[1].alignment_rad = {0.01, 0.0, -0.02};
  const Linearisation at = linearise(problem(), state_of(problem(), model), layout);
  for (std::size_t d = 0; d < 2; ++d) {
    for (int axis = 0; axis < 3; ++axis) {
      constexpr double kTurn_rad = 0.01;
      double sides[2];
      for (const int side : {0, 1}) {
        std::vector<Eigen::Vector3d> turns(2, Eigen::Vector3d::Zero());
        turns[d][axis] = side == 0 ? -kTurn_rad : kTurn_rad;
        JointData turned = data;
        turn(turned, turns);
        JointModel there = model;
        there.drones[d].alignment_rad += turns[d];
        sides[side] = state_of({.config = config, .physics = physics, .data = turned}, there).log_likelihood;
      }
      const double slow = (sides[1] - sides[0]) / (2.0 * kTurn_rad);
      EXPECT_NEAR(at.gradient[layout.alignment(d) + axis], slow, 0.05 * std::abs(slow) + 20.0) << d << " " << axis;
    }
  }
}

TEST_F(JointLikelihood, FindsHowDetectorsAreTurned) {
  const std::vector<Eigen::Vector3d> turns{{0.06, -0.04, 0.05}, {-0.05, 0.0, -0.06}};
  turn(data, turns);
  config.alignment_sigma_rad = 0.1;
  JointState state = state_of(problem(), model);
  for (int i = 0; i < 12; ++i) {
    refit(problem(), kFlat, {0, 1}, 3, 1e-3, state);
    const double before = state.log_likelihood;
    align(config, physics, kFlat, data, state);
    EXPECT_GE(state.log_likelihood, before) << i;
  }
  const ParameterLayout layout{.sources = 2, .drones = 2, .movable = {0, 1}, .align = true};
  const Eigen::MatrixXd covariance = linearise(problem(), state, layout).information.inverse();
  for (std::size_t d = 0; d < 2; ++d) {
    for (int axis = 0; axis < 3; ++axis) {
      const double sigma_rad = std::sqrt(covariance(layout.alignment(d) + axis, layout.alignment(d) + axis));
      EXPECT_NEAR(state.model.drones[d].alignment_rad[axis], -turns[d][axis], 3.0 * sigma_rad) << d << " " << axis;
      EXPECT_LT(sigma_rad, 0.06) << d << " " << axis << ": the data say something";
    }
  }
}

TEST(JointData, TurnsWhatComesLaterAsWhatCameBefore) {
  const ToyField field{.sources = {{.p_W = {5, 6, 0}, .activity_Bq = 2e9}}};
  const auto batches = field.sweep(toy_physics(), 8.0, 2.0, 3);
  const auto middle = batches.begin() + std::ssize(batches) / 2;
  JointData later = data_of({batches.begin(), middle}), before = data_of(batches);
  const std::vector<Eigen::Vector3d> turns{{0.1, -0.2, 0.3}, {-0.05, 0.0, 0.1}};
  turn(before, turns);
  turn(later, {turns.begin(), turns.begin() + std::ssize(later.senders)});
  for (auto batch = middle; batch != batches.end(); ++batch) add(later, *batch, "Cs-137");
  ASSERT_EQ(later.senders.size(), 2);
  turn(later, {Eigen::Vector3d::Zero(), turns[1]});  // the second drone came after the first turn
  ASSERT_EQ(later.pairs.size(), before.pairs.size());
  for (std::size_t i = 0; i < later.pairs.size(); ++i) {
    EXPECT_LT((later.pairs[i].R_DW - before.pairs[i].R_DW).norm(), 1e-12);
    EXPECT_LT((later.pairs[i].hypotheses[0].axis_W - before.pairs[i].hypotheses[0].axis_W).norm(), 1e-12);
  }
  for (int r = 0; r < 9; ++r) {
    for (std::size_t v = 0; v < later.viewpoints.size(); ++v) {
      EXPECT_NEAR(later.viewpoints.R_DW[r][v], before.viewpoints.R_DW[r][v], 1e-12);
    }
  }
}

TEST_F(JointLikelihood, NeverFallsInARefit) {
  JointState state = state_of(problem(), model);
  for (int step = 0; step < 15; ++step) {
    const double before = state.log_likelihood;
    refit(problem(), kFlat, {0, 1}, 1, 0.0, state);
    EXPECT_GE(state.log_likelihood, before) << "step " << step;
  }
  EXPECT_NEAR((state.model.sources[0].p_W - field.sources[0].p_W).norm(), 0.0, 0.5);
  EXPECT_NEAR((state.model.sources[1].p_W - field.sources[1].p_W).norm(), 0.0, 0.5);
}

/// At the optimum all rates together may not gain by growing: sum_v mu_v + expected pairs = all events.
TEST_F(JointLikelihood, ExpectsAsManyEventsAsThereAreOnceFitted) {
  JointState state = state_of(problem(), model);
  refit(problem(), kFlat, {0, 1}, 50, 1e-12, state);
  const Expected sums = expected(problem(), state.model, state.columns);
  const auto total = [](const std::vector<double>& x) { return std::accumulate(x.begin(), x.end(), 0.0); };
  double pairs = 0.0;
  for (std::size_t d = 0; d < 2; ++d) {
    const DroneModel& drone = state.model.drones[d];
    pairs += drone.pairs_per_s * data.live_s[d];
    for (std::size_t k = 0; k < 2; ++k) {
      pairs += drone.scale * state.model.sources[k].activity_Bq * state.columns[k].exposure_s[d];
    }
  }
  const double events = total(data.viewpoints.singles) + static_cast<double>(data.pairs.size());
  EXPECT_NEAR((total(sums.singles) + pairs) / events, 1.0, 1e-4);
}

TEST_F(JointLikelihood, ScoreIsWhatAFirstBecquerelGains) {
  const JointState state = state_of(problem(), model);
  const Residuals pulls = residuals(problem(), state);
  for (const Eigen::Vector3d& p_W : {Eigen::Vector3d(5, 6, 0), {10, 10, 0}, {19.5, 0.5, 0}}) {
    JointModel more = model;
    more.sources.push_back({.p_W = p_W, .activity_Bq = 10.0});
    const double slow = (slow_log_likelihood(problem(), more) - slow_log_likelihood(problem(), model)) / 10.0;
    EXPECT_NEAR(score(problem(), pulls, p_W) / slow, 1.0, 1e-3) << p_W.transpose();
  }
}

TEST_F(JointLikelihood, ScoreMapPointsToASourceThatIsMissing) {
  model.sources.pop_back();
  ScoreMap map(flat_cells({0, 20, 0, 20}, 0.5), 1.0);
  map.extend(problem());
  EXPECT_EQ(map.nodes(), 400U);
  const JointState state = state_of(problem(), model);
  const Residuals pulls = residuals(problem(), state);
  const auto maxima = map.maxima(problem(), pulls, 6);
  ASSERT_FALSE(maxima.empty());
  EXPECT_LE((maxima[0].p_W - field.sources[1].p_W).norm(), 1.5);
  EXPECT_NEAR(maxima[0].score_s / score(problem(), pulls, maxima[0].p_W), 1.0, 0.1);
}

}  // namespace
}  // namespace comptonaut
