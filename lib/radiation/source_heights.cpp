// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/source_heights.h"

#include <Eigen/LU>
#include <algorithm>

namespace comptonaut {
namespace {

constexpr double kLiftMargin = 2.0;
constexpr double kWorthTrying = 0.5;  // share of gain_to_lift that the expected gain must reach
constexpr double kLeast_m = 0.1;      // of a lift that is tried
constexpr int kSteps = 12;
constexpr double kGain = 1e-3;

/// What the likelihood, to second order, says about one height with everything else free.
struct HeightPull {
  double height_m = 0.0;
  double slope_per_m = 0.0;  ///< d log L / d z
  double variance_m2 = 0.0;
};

std::vector<HeightPull> height_pulls(const JointProblem& problem, const Ground& ground, const JointState& state) {
  const std::vector<std::size_t> all = all_of(state.model.sources.size());
  ParameterLayout layout = layout_of(ground, state.model, all);
  layout.lifted = all;
  Linearisation at = linearise(problem, state, layout);
  at.information.diagonal().array() += 1e-9;
  const Eigen::MatrixXd covariance = at.information.inverse();
  std::vector<HeightPull> pulls;
  for (const std::size_t k : all) {
    const std::size_t z = layout.z_m(k);
    pulls.push_back({.height_m = height_m(ground, state.model.sources[k]),
                     .slope_per_m = at.gradient[z],
                     .variance_m2 = covariance(z, z)});
  }
  return pulls;
}

/// The best fit with source k so high.
JointState with_height(const JointProblem& problem, const Ground& ground, const JointState& state, std::size_t k,
                       double height_m) {
  JointState next = state;
  Eigen::Vector3d& p_W = next.model.sources[k].p_W;
  p_W.z() = ground.z_m(p_W.x(), p_W.y()) + height_m;
  fill_column(physics_of(problem.physics, next.model, k), problem.data, p_W, next.columns[k]);
  next.log_likelihood = log_likelihood(problem, next.model, next.columns);
  refit(problem, ground, all_of(next.model.sources.size()), kSteps, kGain, next);
  return next;
}

/// Lifts the source on the surface that promises most.
bool lift_one(const JointProblem& problem, const Ground& ground, const std::vector<HeightPull>& pulls,
              JointState& state) {
  double best_gain = kWorthTrying * problem.config.gain_to_lift, start_m = 0.0;
  std::size_t best = pulls.size();
  for (std::size_t k = state.model.known.size(); k < pulls.size(); ++k) {
    const HeightPull& pull = pulls[k];
    if (pull.height_m > 0.0 || pull.slope_per_m <= 0.0) continue;
    const double gain = 0.5 * pull.slope_per_m * pull.slope_per_m * pull.variance_m2;
    if (gain < best_gain) continue;
    best = k, best_gain = gain;
    start_m = std::clamp(pull.slope_per_m * pull.variance_m2, kLeast_m, ground.limit_m(state.model.sources[k].p_W));
  }
  if (best == pulls.size()) return false;
  JointState lifted = with_height(problem, ground, state, best, start_m);
  if (lifted.log_likelihood - state.log_likelihood < problem.config.gain_to_lift) return false;
  state = std::move(lifted);
  return true;
}

/// Puts the first lifted source back that hardly loses by it.
bool lower_one(const JointProblem& problem, const Ground& ground, const std::vector<HeightPull>& pulls,
               JointState& state) {
  for (std::size_t k = state.model.known.size(); k < pulls.size(); ++k) {
    const double expected_loss = 0.5 * pulls[k].height_m * pulls[k].height_m / pulls[k].variance_m2;
    if (!(pulls[k].height_m > 0.0) || expected_loss > 2.0 * problem.config.gain_to_lift) continue;
    JointState lowered = with_height(problem, ground, state, k, 0.0);
    if (state.log_likelihood - lowered.log_likelihood > problem.config.gain_to_lift - kLiftMargin) continue;
    state = std::move(lowered);
    return true;
  }
  return false;
}

}  // namespace

bool adjust_heights(const JointProblem& problem, const Ground& ground, JointState& state) {
  if (ground.height_max_m < kLeast_m || own_sources(state.model) == 0) return false;
  std::vector<HeightPull> pulls = height_pulls(problem, ground, state);
  const bool lowered = lower_one(problem, ground, pulls, state);
  if (lowered) pulls = height_pulls(problem, ground, state);
  bool lifted = false;
  for (std::size_t n = own_sources(state.model); n > 0 && lift_one(problem, ground, pulls, state); --n) {
    lifted = true;
    pulls = height_pulls(problem, ground, state);
  }
  return lowered || lifted;
}

}  // namespace comptonaut
