// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/sure_loss.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "radiation/sight_lines.h"

namespace comptonaut {
namespace {

/// What brings less is not looked at: rays cost.
constexpr double kNotable = 0.02;

/// A view says nothing for certain of a source that gives less than so much of how far another one's light may be off.
constexpr double kClearly = 5.0;

/// Between what the least and the most lets through, were the obstacles a voxel beside or higher than the map has them:
/// on the eye's side two of them, since the map is halfway there.
double let_through_range(const World& world, double attenuation_per_m, const Eigen::Vector3d& eye_W,
                         const Eigen::Vector3d& p_W) {
  const double voxel_m = world.voxel_m();
  const Eigen::Vector3d way_W = p_W - eye_W;
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ(), left = up.cross(way_W).normalized();
  const std::array<Eigen::Vector3d, 5> eyes = {eye_W, eye_W + 2.0 * voxel_m * up, eye_W - 2.0 * voxel_m * up,
                                               eye_W + 2.0 * voxel_m * left, eye_W - 2.0 * voxel_m * left};
  const std::array<Eigen::Vector3d, 3> places = {p_W + voxel_m * up, p_W + voxel_m * left, p_W - voxel_m * left};
  float least = 1.0F, most = 0.0F;
  const auto look = [&](const Eigen::Vector3d& from_W, const Eigen::Vector3d& to_W) {
    const float share = let_through(world, attenuation_per_m, from_W, to_W);
    least = std::min(least, share);
    most = std::max(most, share);
  };
  for (const Eigen::Vector3d& from_W : eyes) look(from_W, p_W);
  for (const Eigen::Vector3d& to_W : places) look(eye_W, to_W);
  return static_cast<double>(most - least);
}

/// Counts per Bq at a viewpoint, obstacles left out.
double singles_per_Bq(const JointPhysics& physics, const Viewpoints& v, std::size_t at, const Eigen::Vector3d& p_W) {
  const Eigen::Vector3d way_W = p_W - Eigen::Vector3d(v.x_m[at], v.y_m[at], v.z_m[at]);
  Eigen::Matrix3d R_DW;
  for (int i = 0; i < 9; ++i) R_DW(i / 3, i % 3) = v.R_DW[static_cast<std::size_t>(i)][at];
  const Eigen::Vector3d u_D = R_DW * way_W;
  const double d_m = std::max(way_W.norm(), kDistanceMin_m);
  return physics.response(u_D.x(), u_D.y(), u_D.z()).single * std::exp(-physics.attenuation_per_m * d_m) / (d_m * d_m) *
         v.live_s[at];
}

/// Whether obstacles a voxel beside their place would change what comes from the other sources by as much as source k
/// gives. `unshaded(j)`: what source j would give without obstacles, in the unit of `own`.
template <typename Unshaded>
bool is_doubtful(const JointProblem& problem, const JointState& state, std::size_t k, const Eigen::Vector3d& eye_W,
                 double own, const Unshaded& unshaded) {
  for (std::size_t j = 0; j < state.model.sources.size(); ++j) {
    const double most = j == k ? 0.0 : kClearly * unshaded(j);
    if (most < own) continue;
    const double per_m = physics_of(problem.physics, state.model, j).obstacles_per_m;
    const Eigen::Vector3d& p_W = state.model.sources[j].p_W;
    if (most * let_through_range(problem.data.sight->world(), per_m, eye_W, p_W) >= own) return true;
  }
  return false;
}

double of_singles(const JointProblem& problem, const JointState& state, std::size_t k, const Expected& with) {
  const Viewpoints& v = problem.data.viewpoints;
  const std::vector<PointSource>& sources = state.model.sources;
  double sum = 0.0;
  for (std::size_t at = 0; at < v.size(); ++at) {
    const double factor = state.model.drones[static_cast<std::size_t>(v.drone[at])].scale * state.model.scatter;
    const double own = factor * sources[k].activity_Bq * state.columns[k].singles[at];
    const double without = std::max(with.singles[at] - own, 1e-12);
    const double loss = (v.singles[at] > 0.0 ? v.singles[at] * std::log1p(own / without) : 0.0) - own;
    const auto unshaded = [&](std::size_t j) {
      return factor * sources[j].activity_Bq *
             singles_per_Bq(physics_of(problem.physics, state.model, j), v, at, sources[j].p_W);
    };
    const bool counts =
        loss < kNotable || !is_doubtful(problem, state, k, {v.x_m[at], v.y_m[at], v.z_m[at]}, own, unshaded);
    if (counts) sum += loss;
  }
  return sum;
}

double of_pairs(const JointProblem& problem, const JointState& state, std::size_t k, const Expected& with) {
  const std::vector<PointSource>& sources = state.model.sources;
  double sum = 0.0;
  for (std::size_t i = 0; i < problem.data.pairs.size(); ++i) {
    const Pair& pair = problem.data.pairs[i];
    const double scale = state.model.drones[static_cast<std::size_t>(pair.drone)].scale;
    const double own = scale * sources[k].activity_Bq * state.columns[k].pairs[i];
    const double loss = std::log1p(own / std::max(with.pairs[i] - own, 1e-12));
    const auto unshaded = [&](std::size_t j) {
      return scale * sources[j].activity_Bq *
             pair_density(physics_of(problem.physics, state.model, j), pair, sources[j].p_W);
    };
    if (loss < kNotable || !is_doubtful(problem, state, k, pair.p_WS, own, unshaded)) sum += loss;
  }
  for (std::size_t d = 0; d < state.model.drones.size(); ++d) {
    sum -= state.model.drones[d].scale * sources[k].activity_Bq * state.columns[k].exposure_s[d];
  }
  return sum;
}

}  // namespace

double sure_loss(const JointProblem& problem, const JointState& state, std::size_t k) {
  const Expected with = expected(problem, state.model, state.columns);
  double sum = 0.0;
  if (problem.config.use_singles) sum += of_singles(problem, state, k, with);
  if (problem.config.use_pairs) sum += of_pairs(problem, state, k, with);
  return sum;
}

}  // namespace comptonaut
