// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/joint_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace comptonaut {
namespace {

constexpr double kStep_m = 1e-4;  // of the columns' differences
constexpr double kActivityMin_Bq = 1.0;
constexpr double kRateMin_per_s = 1e-6;
constexpr double kLogStepMax = 1.5;
constexpr double kMoveMax_m = 3.0;
constexpr double kDampingMin = 1e-6;
constexpr double kDampingMax = 1e4;
constexpr Eigen::Index kRows = 256;  // of the derivatives' matrix at a time: one order of summation everywhere

/// d column / d x and d column / d y of each movable source.
using Slopes = std::vector<ResponseColumn>;

Slopes slopes_of(const JointProblem& problem, const JointState& state, const ParameterLayout& layout) {
  Slopes slopes(2 * layout.movable.size());
  for (std::size_t m = 0; m < layout.movable.size(); ++m) {
    const std::size_t k = layout.movable[m];
    const ResponseColumn& here = state.columns[k];
    for (int axis = 0; axis < 2; ++axis) {
      ResponseColumn& slope = slopes[2 * m + axis];
      const Eigen::Vector3d beside_W = state.model.sources[k].p_W + kStep_m * Eigen::Vector3d::Unit(axis);
      fill_column(problem.physics, problem.data, beside_W, slope);
      const auto difference = [](std::vector<double>& there, const std::vector<double>& at) {
        for (std::size_t i = 0; i < there.size(); ++i) there[i] = (there[i] - at[i]) / kStep_m;
      };
      difference(slope.singles, here.singles);
      difference(slope.pairs, here.pairs);
      difference(slope.exposure_s, here.exposure_s);
    }
  }
  return slopes;
}

/// Adds what the derivatives J of some rows' expectations mu, with counts n, say: J^T (n / mu - 1) or, for pairs,
/// J^T (1 / f), and J^T diag(weight) J.
class Accumulator {
 public:
  explicit Accumulator(Eigen::Index parameters)
      : derivatives_(kRows, parameters),
        gradient_(Eigen::VectorXd::Zero(parameters)),
        information_(Eigen::MatrixXd::Zero(parameters, parameters)) {}

  /// The next kRows rows, at zero, to be filled.
  Eigen::MatrixXd& clear() {
    derivatives_.setZero();
    return derivatives_;
  }
  void add(const Eigen::VectorXd& pull, const Eigen::VectorXd& weight_root) {
    gradient_.noalias() += derivatives_.transpose() * pull;
    derivatives_.array().colwise() *= weight_root.array();
    information_.selfadjointView<Eigen::Lower>().rankUpdate(derivatives_.transpose());
  }
  [[nodiscard]] Linearisation result() const {
    return {.gradient = gradient_, .information = information_.selfadjointView<Eigen::Lower>()};
  }

 private:
  Eigen::MatrixXd derivatives_;
  Eigen::VectorXd gradient_;
  Eigen::MatrixXd information_;
};

void add_singles(const JointProblem& problem, const JointState& state, const ParameterLayout& layout,
                 const Slopes& slopes, const std::vector<double>& mu, Accumulator& sums) {
  const Viewpoints& v = problem.data.viewpoints;
  const JointModel& model = state.model;
  Eigen::VectorXd pull(kRows), weight_root(kRows);
  for (std::size_t first = 0; first < v.size(); first += kRows) {
    const std::size_t n = std::min<std::size_t>(kRows, v.size() - first);
    Eigen::MatrixXd& J = sums.clear();
    pull.setZero();
    weight_root.setZero();
    for (std::size_t k = 0; k < layout.sources; ++k) {
      for (std::size_t r = 0; r < n; ++r) {
        const double scale = model.drones[v.drone[first + r]].scale * model.scatter;
        J(r, layout.log_activity(k)) = scale * model.sources[k].activity_Bq * state.columns[k].singles[first + r];
      }
    }
    for (std::size_t s = 0; s < slopes.size(); ++s) {
      const double activity_Bq = model.sources[layout.movable[s / 2]].activity_Bq;
      for (std::size_t r = 0; r < n; ++r) {
        const double scale = model.drones[v.drone[first + r]].scale * model.scatter;
        J(r, layout.x_m(0) + s) = scale * activity_Bq * slopes[s].singles[first + r];
      }
    }
    for (std::size_t r = 0; r < n; ++r) {
      const std::size_t d = v.drone[first + r];
      const double background = model.drones[d].singles_per_s * v.live_s[first + r];
      const double from_sources = mu[first + r] - background;
      J(r, layout.log_singles(d)) = background;
      J(r, layout.scale(d)) = from_sources / model.drones[d].scale;
      J(r, layout.scatter()) = from_sources / model.scatter;
      pull[r] = v.singles[first + r] / mu[first + r] - 1.0;
      weight_root[r] = 1.0 / std::sqrt(mu[first + r]);
    }
    sums.add(pull, weight_root);
  }
}

void add_pairs(const JointProblem& problem, const JointState& state, const ParameterLayout& layout,
               const Slopes& slopes, const std::vector<double>& f, Accumulator& sums) {
  const auto& pairs = problem.data.pairs;
  const JointModel& model = state.model;
  Eigen::VectorXd pull(kRows);
  for (std::size_t first = 0; first < pairs.size(); first += kRows) {
    const std::size_t n = std::min<std::size_t>(kRows, pairs.size() - first);
    Eigen::MatrixXd& J = sums.clear();
    pull.setZero();
    for (std::size_t r = 0; r < n; ++r) {
      const std::size_t i = first + r, d = pairs[i].drone;
      const DroneModel& drone = model.drones[d];
      for (std::size_t k = 0; k < layout.sources; ++k) {
        J(r, layout.log_activity(k)) = drone.scale * model.sources[k].activity_Bq * state.columns[k].pairs[i];
      }
      for (std::size_t s = 0; s < slopes.size(); ++s) {
        J(r, layout.x_m(0) + s) = drone.scale * model.sources[layout.movable[s / 2]].activity_Bq * slopes[s].pairs[i];
      }
      const double background = drone.pairs_per_s * kIsotropic_per_sr;
      J(r, layout.log_pairs(d)) = background;
      J(r, layout.scale(d)) = (f[i] - background) / drone.scale;
      pull[r] = 1.0 / f[i];
    }
    sums.add(pull, pull);
  }
}

/// - scale_d sum_k A_k s^c_kd - b_c,d T_d
void add_exposure(const JointProblem& problem, const JointState& state, const ParameterLayout& layout,
                  const Slopes& slopes, Eigen::VectorXd& gradient) {
  const JointModel& model = state.model;
  for (std::size_t d = 0; d < layout.drones; ++d) {
    const DroneModel& drone = model.drones[d];
    for (std::size_t k = 0; k < layout.sources; ++k) {
      const double pairs = model.sources[k].activity_Bq * state.columns[k].exposure_s[d];
      gradient[layout.log_activity(k)] -= drone.scale * pairs;
      gradient[layout.scale(d)] -= pairs;
    }
    for (std::size_t s = 0; s < slopes.size(); ++s) {
      const double activity_Bq = model.sources[layout.movable[s / 2]].activity_Bq;
      gradient[layout.x_m(0) + s] -= drone.scale * activity_Bq * slopes[s].exposure_s[d];
    }
    gradient[layout.log_pairs(d)] -= drone.pairs_per_s * problem.data.live_s[d];
  }
}

void add_prior(const JointConfig& config, const JointModel& model, const ParameterLayout& layout, Linearisation& sums) {
  const auto add = [&](std::size_t at, double pull, double sigma) {
    sums.gradient[at] -= pull / (sigma * sigma);
    sums.information(at, at) += 1.0 / (sigma * sigma);
  };
  for (std::size_t d = 0; d < layout.drones; ++d) {
    add(layout.scale(d), model.drones[d].scale - 1.0, config.response_rel_sigma);
  }
  add(layout.scatter(), model.scatter - 1.0 - config.scatter_share, config.scatter_share_sigma);
}

double times_exp(double value, double log_step, double least) {
  return std::max(least, value * std::exp(std::clamp(log_step, -kLogStepMax, kLogStepMax)));
}

JointModel stepped(const JointModel& from, const ParameterLayout& layout, const Ground& ground,
                   const Eigen::VectorXd& step) {
  JointModel model = from;
  for (std::size_t k = 0; k < layout.sources; ++k) {
    double& activity_Bq = model.sources[k].activity_Bq;
    activity_Bq = times_exp(activity_Bq, step[layout.log_activity(k)], kActivityMin_Bq);
  }
  for (std::size_t m = 0; m < layout.movable.size(); ++m) {
    Eigen::Vector3d& p_W = model.sources[layout.movable[m]].p_W;
    Eigen::Vector2d move_m = step.segment<2>(static_cast<Eigen::Index>(layout.x_m(m)));
    if (move_m.norm() > kMoveMax_m) move_m *= kMoveMax_m / move_m.norm();
    p_W.x() = std::clamp(p_W.x() + move_m.x(), ground.area.x_min_m, ground.area.x_max_m);
    p_W.y() = std::clamp(p_W.y() + move_m.y(), ground.area.y_min_m, ground.area.y_max_m);
    p_W.z() = ground.z_m(p_W.x(), p_W.y());
  }
  for (std::size_t d = 0; d < layout.drones; ++d) {
    DroneModel& drone = model.drones[d];
    drone.singles_per_s = times_exp(drone.singles_per_s, step[layout.log_singles(d)], kRateMin_per_s);
    drone.pairs_per_s = times_exp(drone.pairs_per_s, step[layout.log_pairs(d)], kRateMin_per_s);
    drone.scale = std::max(0.1, drone.scale + step[layout.scale(d)]);
  }
  model.scatter = std::max(0.5, model.scatter + step[layout.scatter()]);
  return model;
}

JointState tried(const JointProblem& problem, const ParameterLayout& layout, const JointState& from, JointModel model) {
  JointState state{.model = std::move(model), .columns = from.columns, .log_likelihood = 0.0};
  for (const std::size_t k : layout.movable) {
    fill_column(problem.physics, problem.data, state.model.sources[k].p_W, state.columns[k]);
  }
  state.log_likelihood = log_likelihood(problem, state.model, state.columns);
  return state;
}

Eigen::VectorXd damped_step(const Linearisation& at, double damping) {
  Eigen::MatrixXd matrix = at.information;
  matrix.diagonal() += damping * at.information.diagonal() + Eigen::VectorXd::Constant(at.gradient.size(), 1e-9);
  return matrix.ldlt().solve(at.gradient);
}

}  // namespace

std::vector<std::size_t> all_of(std::size_t n) {
  std::vector<std::size_t> all(n);
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

Linearisation linearise(const JointProblem& problem, const JointState& state, const ParameterLayout& layout) {
  const Slopes slopes = slopes_of(problem, state, layout);
  const Expected sums = expected(problem, state.model, state.columns);
  Accumulator accumulator(static_cast<Eigen::Index>(layout.size()));
  if (problem.config.use_singles) add_singles(problem, state, layout, slopes, sums.singles, accumulator);
  if (problem.config.use_pairs) add_pairs(problem, state, layout, slopes, sums.pairs, accumulator);
  Linearisation result = accumulator.result();
  if (problem.config.use_pairs) add_exposure(problem, state, layout, slopes, result.gradient);
  add_prior(problem.config, state.model, layout, result);
  return result;
}

void refit(const JointProblem& problem, const Ground& ground, const std::vector<std::size_t>& movable, int steps,
           double gain_min, JointState& state) {
  const ParameterLayout layout{
      .sources = state.model.sources.size(), .drones = state.model.drones.size(), .movable = movable};
  double damping = 1e-3;
  for (int step = 0; step < steps; ++step) {
    const Linearisation at = linearise(problem, state, layout);
    double gain = -1.0;
    while (gain < 0.0 && damping <= kDampingMax) {
      JointState next = tried(problem, layout, state, stepped(state.model, layout, ground, damped_step(at, damping)));
      gain = next.log_likelihood - state.log_likelihood;
      if (gain >= 0.0) state = std::move(next);
      damping = gain >= 0.0 ? std::max(kDampingMin, 0.1 * damping) : 10.0 * damping;
    }
    if (gain < gain_min) return;
  }
}

}  // namespace comptonaut
