// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/joint_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace comptonaut {
namespace {

constexpr double kActivityMin_Bq = 1.0;
constexpr double kRateMin_per_s = 1e-6;
constexpr double kLogStepMax = 1.5;
constexpr double kMoveMax_m = 3.0;
constexpr double kHeightMin_m = 1e-3;  // of a source whose height is fitted: lower ones would count as on the surface
constexpr double kDampingMin = 1e-6;
constexpr double kDampingMax = 1e4;

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
    const double above_m = height_m(ground, model.sources[layout.movable[m]]);
    p_W.x() = std::clamp(p_W.x() + move_m.x(), ground.area.x_min_m, ground.area.x_max_m);
    p_W.y() = std::clamp(p_W.y() + move_m.y(), ground.area.y_min_m, ground.area.y_max_m);
    p_W.z() = ground.z_m(p_W.x(), p_W.y()) + above_m;
  }
  for (std::size_t l = 0; l < layout.lifted.size(); ++l) {
    PointSource& source = model.sources[layout.lifted[l]];
    const double above_m = height_m(ground, source);
    source.p_W.z() += std::clamp(above_m + step[layout.z_m(l)], kHeightMin_m, ground.limit_m(source.p_W)) - above_m;
  }
  for (std::size_t d = 0; d < layout.drones; ++d) {
    DroneModel& drone = model.drones[d];
    drone.singles_per_s = times_exp(drone.singles_per_s, step[layout.log_singles(d)], kRateMin_per_s);
    drone.pairs_per_s = times_exp(drone.pairs_per_s, step[layout.log_pairs(d)], kRateMin_per_s);
    drone.scale = std::max(0.1, drone.scale + step[layout.scale(d)]);
    for (std::size_t j = 0; j < layout.drift_points; ++j) {
      drone.drift[j] += std::clamp(step[layout.drift(d, j)], -kLogStepMax, kLogStepMax);
    }
    if (layout.align) drone.alignment_rad += step.segment<3>(static_cast<Eigen::Index>(layout.alignment(d)));
  }
  model.scatter = std::max(0.5, model.scatter + step[layout.scatter()]);
  return model;
}

JointState tried(const JointProblem& problem, const ParameterLayout& layout, const JointState& from, JointModel model) {
  JointState state{.model = std::move(model), .columns = from.columns, .log_likelihood = 0.0};
  for (const std::size_t k : layout.movable) {
    fill_column(physics_of(problem.physics, state.model, k), problem.data, state.model.sources[k].p_W,
                state.columns[k]);
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

double height_m(const Ground& ground, const PointSource& source) {
  return source.p_W.z() - ground.z_m(source.p_W.x(), source.p_W.y());
}

ParameterLayout layout_of(const Ground& ground, const JointModel& model, const std::vector<std::size_t>& movable,
                          bool align) {
  ParameterLayout layout{
      .sources = model.sources.size(), .drones = model.drones.size(), .movable = movable, .align = align};
  for (const std::size_t k : movable) {
    if (k >= model.known.size() && height_m(ground, model.sources[k]) > 0.5 * kHeightMin_m) layout.lifted.push_back(k);
  }
  if (!model.drones.empty()) layout.drift_points = model.drones[0].drift.size();
  return layout;
}

void refit(const JointProblem& problem, const Ground& ground, const std::vector<std::size_t>& movable, int steps,
           double gain_min, JointState& state) {
  const ParameterLayout layout = layout_of(ground, state.model, movable);
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

void align(const JointConfig& config, const JointPhysics& physics, const Ground& ground, JointData& data,
           JointState& state) {
  const ParameterLayout layout = layout_of(ground, state.model, all_of(state.model.sources.size()), true);
  const Linearisation at = linearise({.config = config, .physics = physics, .data = data}, state, layout);
  for (double damping = 1e-3; damping <= kDampingMax; damping *= 10.0) {
    const Eigen::VectorXd step = damped_step(at, damping);
    JointModel model = stepped(state.model, layout, ground, step);
    std::vector<Eigen::Vector3d> rotations_D;
    for (std::size_t d = 0; d < layout.drones; ++d) {
      rotations_D.push_back(model.drones[d].alignment_rad - state.model.drones[d].alignment_rad);
    }
    JointData turned = data;
    turn(turned, rotations_D);
    JointState next = state_of({.config = config, .physics = physics, .data = turned}, std::move(model));
    if (next.log_likelihood < state.log_likelihood) continue;
    data = std::move(turned);
    state = std::move(next);
    return;
  }
}

}  // namespace comptonaut
