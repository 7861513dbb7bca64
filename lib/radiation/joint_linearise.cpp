// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "radiation/column_products.h"
#include "radiation/joint_fit.h"

namespace comptonaut {
namespace {

constexpr double kStep_m = 1e-4;     // of the columns' differences
constexpr double kTurn_rad = 0.01;   // likewise; the response's and the cones' tables are that coarse
constexpr Eigen::Index kRows = 256;  // of the derivatives' matrix at a time: one order of summation everywhere

/// Derivatives by a place's coordinate, of which source, at which parameter.
struct Slope {
  std::size_t source = 0, parameter = 0;
  const ResponseColumn& per_m;
};
using Slopes = std::vector<Slope>;

Slopes slopes_of(const JointProblem& problem, const JointState& state, const ParameterLayout& layout) {
  Slopes slopes;
  const auto add = [&](std::size_t k, std::size_t parameter, int axis) {
    slopes.push_back({.source = k, .parameter = parameter, .per_m = slope_of(problem, state, k, axis)});
  };
  for (std::size_t m = 0; m < layout.movable.size(); ++m) {
    for (const int axis : {0, 1}) add(layout.movable[m], layout.x_m(m) + axis, axis);
  }
  for (std::size_t l = 0; l < layout.lifted.size(); ++l) add(layout.lifted[l], layout.z_m(l), 2);
  return slopes;
}

/// Derivatives of what all sources together give by a turn of the detectors about each axis of D.
std::vector<ResponseColumn> turns_of(const JointProblem& problem, const JointState& state,
                                     const ParameterLayout& layout) {
  if (!layout.align) return {};
  std::vector<ResponseColumn> turns(3);
  for (int axis = 0; axis < 3; ++axis) {
    ResponseColumn& turn_by = turns[axis];
    turn_by.singles.assign(problem.data.viewpoints.size(), 0.0);
    turn_by.pairs.assign(problem.data.pairs.size(), 0.0);
    turn_by.exposure_s.assign(layout.drones, 0.0);
    for (const double side : {-1.0, 1.0}) {
      JointData turned = problem.data;
      turn(turned, std::vector<Eigen::Vector3d>(layout.drones, side * kTurn_rad * Eigen::Vector3d::Unit(axis)));
      ResponseColumn there;
      for (std::size_t k = 0; k < state.model.sources.size(); ++k) {
        const PointSource& source = state.model.sources[k];
        fill_column(physics_of(problem.physics, state.model, k), turned, source.p_W, there);
        const double factor = side * source.activity_Bq / (2.0 * kTurn_rad);
        const auto add = [factor](std::vector<double>& sum, const std::vector<double>& values) {
          for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += factor * values[i];
        };
        add(turn_by.singles, there.singles);
        add(turn_by.pairs, there.pairs);
        add(turn_by.exposure_s, there.exposure_s);
      }
    }
  }
  return turns;
}

/// Adds what the derivatives J of some rows' expectations mu, with counts n, say: J^T (n / mu - 1) or, for pairs,
/// J^T (1 / f), and J^T diag(weight) J.
class Accumulator {
 public:
  explicit Accumulator(Eigen::Index parameters)
      : parameters_(parameters),
        derivatives_(kRows, even(parameters)),
        gradient_(Eigen::VectorXd::Zero(even(parameters))),
        information_(Eigen::MatrixXd::Zero(even(parameters), even(parameters))) {}

  /// The next kRows rows, at zero, to be filled.
  Eigen::MatrixXd& clear() {
    derivatives_.setZero();
    return derivatives_;
  }
  void add(const Eigen::VectorXd& pull, const Eigen::VectorXd& weight_root) {
    gradient_.noalias() += derivatives_.transpose() * pull;
    derivatives_.array().colwise() *= weight_root.array();
    add_products(derivatives_, information_);
  }
  [[nodiscard]] Linearisation result() const {
    const Eigen::MatrixXd information = information_.selfadjointView<Eigen::Lower>();
    return {.gradient = gradient_.head(parameters_),
            .information = information.topLeftCorner(parameters_, parameters_)};
  }

 private:
  static Eigen::Index even(Eigen::Index n) { return n + n % 2; }

  Eigen::Index parameters_;
  Eigen::MatrixXd derivatives_;  ///< of an even number of parameters
  Eigen::VectorXd gradient_;
  Eigen::MatrixXd information_;
};

void add_singles(const JointProblem& problem, const JointState& state, const ParameterLayout& layout,
                 const Slopes& slopes, const std::vector<ResponseColumn>& turns, const std::vector<double>& mu,
                 Accumulator& sums) {
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
    for (const Slope& slope : slopes) {
      const double activity_Bq = model.sources[slope.source].activity_Bq;
      for (std::size_t r = 0; r < n; ++r) {
        const double scale = model.drones[v.drone[first + r]].scale * model.scatter;
        J(r, slope.parameter) = scale * activity_Bq * slope.per_m.singles[first + r];
      }
    }
    for (std::size_t r = 0; r < n; ++r) {
      const std::size_t d = v.drone[first + r];
      const double alone = background(problem, model, first + r);
      const double from_sources = mu[first + r] - alone;
      J(r, layout.log_singles(d)) = alone;
      if (layout.drift_points > 0) {
        const auto [at, share] = drift_place(problem, v.utime[first + r], layout.drift_points);
        J(r, layout.drift(d, at)) = alone * share;
        if (at > 0) J(r, layout.drift(d, at - 1)) = alone * (1.0 - share);
      }
      J(r, layout.scale(d)) = from_sources / model.drones[d].scale;
      J(r, layout.scatter()) = from_sources / model.scatter;
      for (std::size_t axis = 0; axis < turns.size(); ++axis) {
        J(r, layout.alignment(d) + axis) = model.drones[d].scale * model.scatter * turns[axis].singles[first + r];
      }
      pull[r] = v.singles[first + r] / mu[first + r] - 1.0;
      weight_root[r] = 1.0 / std::sqrt(mu[first + r]);
    }
    sums.add(pull, weight_root);
  }
}

void add_pairs(const JointProblem& problem, const JointState& state, const ParameterLayout& layout,
               const Slopes& slopes, const std::vector<ResponseColumn>& turns, const std::vector<double>& f,
               Accumulator& sums) {
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
      for (const Slope& slope : slopes) {
        J(r, slope.parameter) = drone.scale * model.sources[slope.source].activity_Bq * slope.per_m.pairs[i];
      }
      const double isotropic = drone.pairs_per_s * kIsotropic_per_sr;
      J(r, layout.log_pairs(d)) = isotropic;
      J(r, layout.scale(d)) = (f[i] - isotropic) / drone.scale;
      for (std::size_t axis = 0; axis < turns.size(); ++axis) {
        J(r, layout.alignment(d) + axis) = drone.scale * turns[axis].pairs[i];
      }
      pull[r] = 1.0 / f[i];
    }
    sums.add(pull, pull);
  }
}

/// - scale_d sum_k A_k s^c_kd - b_c,d T_d
void add_exposure(const JointProblem& problem, const JointState& state, const ParameterLayout& layout,
                  const Slopes& slopes, const std::vector<ResponseColumn>& turns, Eigen::VectorXd& gradient) {
  const JointModel& model = state.model;
  for (std::size_t d = 0; d < layout.drones; ++d) {
    const DroneModel& drone = model.drones[d];
    for (std::size_t k = 0; k < layout.sources; ++k) {
      const double pairs = model.sources[k].activity_Bq * state.columns[k].exposure_s[d];
      gradient[layout.log_activity(k)] -= drone.scale * pairs;
      gradient[layout.scale(d)] -= pairs;
    }
    for (const Slope& slope : slopes) {
      const double activity_Bq = model.sources[slope.source].activity_Bq;
      gradient[slope.parameter] -= drone.scale * activity_Bq * slope.per_m.exposure_s[d];
    }
    gradient[layout.log_pairs(d)] -= drone.pairs_per_s * problem.data.live_s[d];
    for (std::size_t axis = 0; axis < turns.size(); ++axis) {
      gradient[layout.alignment(d) + axis] -= drone.scale * turns[axis].exposure_s[d];
    }
  }
}

/// - sum_j ((drift_j - drift_j-1) / sigma)^2 / 2, the parameters beginning at `first`.
void add_walk(const JointConfig& config, const DroneModel& drone, std::size_t first, std::size_t points,
              Linearisation& sums) {
  const double weight = 1.0 / (config.drift_sigma * config.drift_sigma);
  for (std::size_t j = 0; j < points; ++j) {
    const std::size_t here = first + j;
    const double pull = weight * (drone.drift[j] - (j > 0 ? drone.drift[j - 1] : 0.0));
    sums.gradient[here] -= pull;
    sums.information(here, here) += weight;
    if (j == 0) continue;
    sums.gradient[here - 1] += pull;
    sums.information(here - 1, here - 1) += weight;
    sums.information(here, here - 1) -= weight;
    sums.information(here - 1, here) -= weight;
  }
}

void add_prior(const JointConfig& config, const JointModel& model, const ParameterLayout& layout, Linearisation& sums) {
  const auto add = [&](std::size_t at, double pull, double sigma) {
    sums.gradient[at] -= pull / (sigma * sigma);
    sums.information(at, at) += 1.0 / (sigma * sigma);
  };
  for (std::size_t d = 0; d < layout.drones; ++d) {
    add(layout.scale(d), model.drones[d].scale - 1.0, std::max(config.response_rel_sigma, model.response_spread));
    add_walk(config, model.drones[d], layout.drift(d, 0), layout.drift_points, sums);
    for (int axis = 0; layout.align && axis < 3; ++axis) {
      add(layout.alignment(d) + axis, model.drones[d].alignment_rad[axis], config.alignment_sigma_rad);
    }
  }
  add(layout.scatter(), model.scatter - 1.0 - config.scatter_share, config.scatter_share_sigma);
  for (std::size_t k = 0; k < model.known.size(); ++k) {
    const double log_ratio = std::log(model.sources[k].activity_Bq / model.known[k].source.activity_Bq);
    add(layout.log_activity(k), log_ratio, model.known[k].activity_rel_sigma);
  }
  for (std::size_t m = 0; m < layout.movable.size(); ++m) {
    const std::size_t k = layout.movable[m];
    if (k >= model.known.size()) continue;
    const auto x = static_cast<Eigen::Index>(layout.x_m(m));
    const Eigen::Vector2d off_m = (model.sources[k].p_W - model.known[k].source.p_W).head<2>();
    sums.gradient.segment<2>(x) -= model.known[k].place_information * off_m;
    sums.information.block<2, 2>(x, x) += model.known[k].place_information;
  }
}

}  // namespace

const ResponseColumn& slope_of(const JointProblem& problem, const JointState& state, std::size_t k, int axis) {
  const ResponseColumn& here = state.columns[k];
  std::shared_ptr<const ResponseColumn>& kept = here.slope_per_m[axis];
  if (kept) return *kept;
  const Eigen::Vector3d beside_W = state.model.sources[k].p_W + kStep_m * Eigen::Vector3d::Unit(axis);
  ResponseColumn slope;
  fill_column(physics_of(problem.physics, state.model, k), problem.data, beside_W, slope);
  const auto difference = [](std::vector<double>& there, const std::vector<double>& at) {
    for (std::size_t i = 0; i < there.size(); ++i) there[i] = (there[i] - at[i]) / kStep_m;
  };
  difference(slope.singles, here.singles);
  difference(slope.pairs, here.pairs);
  difference(slope.exposure_s, here.exposure_s);
  kept = std::make_shared<const ResponseColumn>(std::move(slope));
  return *kept;
}

Linearisation linearise(const JointProblem& problem, const JointState& state, const ParameterLayout& layout) {
  const Slopes slopes = slopes_of(problem, state, layout);
  const std::vector<ResponseColumn> turns = turns_of(problem, state, layout);
  const Expected sums = expected(problem, state.model, state.columns);
  Accumulator accumulator(static_cast<Eigen::Index>(layout.size()));
  if (problem.config.use_singles) add_singles(problem, state, layout, slopes, turns, sums.singles, accumulator);
  if (problem.config.use_pairs) add_pairs(problem, state, layout, slopes, turns, sums.pairs, accumulator);
  Linearisation result = accumulator.result();
  if (problem.config.use_pairs) add_exposure(problem, state, layout, slopes, turns, result.gradient);
  add_prior(problem.config, state.model, layout, result);
  return result;
}

}  // namespace comptonaut
