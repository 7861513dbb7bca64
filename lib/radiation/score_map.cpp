// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/score_map.h"

#include <algorithm>
#include <cmath>

#include "radiation/exp_minus.h"
#include "radiation/sight_lines.h"
#include "radiation/view.h"

namespace comptonaut {
namespace {

/// Edge of the blocks of air whose viewpoints count as one.
constexpr double kBlock_m = 1.0;

Cells nodes_of(const Cells& cells, double spacing_m) {
  struct Sum {
    Eigen::Vector3d p_W = Eigen::Vector3d::Zero();
    double n = 0.0;
  };
  const double edge_m = std::max(spacing_m, cells.cell_m());
  std::map<VoxelKey, Sum> sums;
  for (std::size_t j = 0; j < cells.size(); ++j) {
    Sum& sum = sums[voxel_at(cells.p_W(j), edge_m)];
    sum.p_W += cells.p_W(j);
    sum.n += 1.0;
  }
  std::vector<Cells::Cell> nodes;
  for (const auto& [key, sum] : sums) nodes.push_back({.key = key, .p_W = sum.p_W / sum.n});
  return {edge_m, std::move(nodes)};
}

std::vector<Eigen::Vector3d> nearest_cells(const Cells& nodes, const Cells& cells) {
  std::vector<Eigen::Vector3d> nearest(nodes.size(), Eigen::Vector3d::Constant(1e9));
  for (std::size_t j = 0; j < cells.size(); ++j) {
    const auto node = nodes.find(voxel_at(cells.p_W(j), nodes.cell_m()));
    if (!node) continue;
    const double away_m = (cells.p_W(j) - nodes.p_W(*node)).norm();
    if (away_m < (nearest[*node] - nodes.p_W(*node)).norm()) nearest[*node] = cells.p_W(j);
  }
  return nearest;
}

/// As if one viewpoint stood in the middle of its block, turned as it is.
JointData viewpoint_in_block(const Viewpoints& v, std::size_t at, const VoxelKey& block) {
  JointData one;
  one.live_s = {1.0};
  one.senders = {0};
  one.viewpoints.x_m = {(block.x + 0.5) * kBlock_m};
  one.viewpoints.y_m = {(block.y + 0.5) * kBlock_m};
  one.viewpoints.z_m = {v.z_m[at]};
  for (int i = 0; i < 9; ++i) one.viewpoints.R_DW[i] = {v.R_DW[i][at]};
  one.viewpoints.live_s = {1.0};
  one.viewpoints.singles = {0.0};
  one.viewpoints.drone = {0};
  return one;
}

}  // namespace

Residuals residuals(const JointProblem& problem, const JointState& state) {
  const Viewpoints& v = problem.data.viewpoints;
  const JointModel& model = state.model;
  const Expected sums = expected(problem, model, state.columns);
  Residuals result;
  result.singles.assign(v.size(), 0.0);
  result.pairs.assign(problem.data.pairs.size(), 0.0);
  result.exposure.assign(model.drones.size(), 0.0);
  for (std::size_t i = 0; problem.config.use_singles && i < v.size(); ++i) {
    result.singles[i] = model.drones[v.drone[i]].scale * model.scatter * (v.singles[i] / sums.singles[i] - 1.0);
  }
  for (std::size_t i = 0; problem.config.use_pairs && i < result.pairs.size(); ++i) {
    result.pairs[i] = model.drones[problem.data.pairs[i].drone].scale / sums.pairs[i];
  }
  for (std::size_t d = 0; problem.config.use_pairs && d < model.drones.size(); ++d) {
    result.exposure[d] = model.drones[d].scale;
  }
  return result;
}

double score(const JointProblem& problem, const Residuals& residuals, const Eigen::Vector3d& p_W) {
  ResponseColumn column;
  fill_column(problem.physics, problem.data, p_W, column);
  double g = 0.0;
  for (std::size_t v = 0; v < column.singles.size(); ++v) g += residuals.singles[v] * column.singles[v];
  for (std::size_t i = 0; i < column.pairs.size(); ++i) g += residuals.pairs[i] * column.pairs[i];
  for (std::size_t d = 0; d < column.exposure_s.size(); ++d) g -= residuals.exposure[d] * column.exposure_s[d];
  return g;
}

ScoreMap::ScoreMap(const Cells& cells, double spacing_m)
    : nodes_(nodes_of(cells, spacing_m)), surface_W_(nearest_cells(nodes_, cells)), singles_s_(nodes_.size(), 0.0) {}

std::size_t ScoreMap::block_of(const JointProblem& problem, std::size_t viewpoint) {
  const Viewpoints& v = problem.data.viewpoints;
  const VoxelKey key = voxel_at({v.x_m[viewpoint], v.y_m[viewpoint], v.z_m[viewpoint]}, kBlock_m);
  const auto [at, fresh] = block_at_.emplace(key, blocks_.size());
  if (!fresh) return at->second;
  const JointData one = viewpoint_in_block(v, viewpoint, key);
  Block block;
  ResponseColumn column;
  for (std::size_t j = 0; j < nodes_.size(); ++j) {
    fill_column(problem.physics, one, nodes_.p_W(j), column);
    block.kernel.push_back(static_cast<float>(column.singles[0]));
  }
  if (problem.data.sight) {
    const Eigen::Vector3d eye_W(one.viewpoints.x_m[0], one.viewpoints.y_m[0], one.viewpoints.z_m[0]);
    block.let_through = let_through(problem.data.sight->world(), problem.physics.obstacles_per_m, eye_W, surface_W_);
    for (std::size_t j = 0; j < nodes_.size(); ++j) block.kernel[j] *= block.let_through[j];
  }
  blocks_.push_back(std::move(block));
  return at->second;
}

void ScoreMap::extend(const JointProblem& problem) {
  const Viewpoints& v = problem.data.viewpoints;
  const JointPhysics& physics = problem.physics;
  exposure_s_.resize(problem.data.live_s.size(), std::vector<double>(nodes_.size(), 0.0));
  for (std::size_t i = block_of_viewpoint_.size(); i < v.size(); ++i) {
    block_of_viewpoint_.push_back(block_of(problem, i));
    const Eigen::Vector3d p_WD(v.x_m[i], v.y_m[i], v.z_m[i]);
    Eigen::Matrix3d R_DW;
    for (int r = 0; r < 9; ++r) R_DW(r / 3, r % 3) = v.R_DW[r][i];
    const std::vector<float>& through = blocks_[block_of_viewpoint_[i]].let_through;
    for (std::size_t j = 0; j < nodes_.size(); ++j) {
      const Eigen::Vector3d to_W = nodes_.p_W(j) - p_WD;
      const double square = std::max(to_W.squaredNorm(), kDistanceMin_m * kDistanceMin_m);
      double weight = v.live_s[i] * exp_minus_inline(physics.attenuation_per_m * std::sqrt(square)) / square;
      if (!through.empty()) weight *= through[j];
      const Eigen::Vector3d u_D = R_DW * to_W;
      const Response L = physics.response(u_D.x(), u_D.y(), u_D.z() + 1e-12);
      exposure_s_[v.drone[i]][j] += weight * L.pair;
      singles_s_[j] += weight * L.single;
    }
  }
  for (std::size_t i = pair_rows_.size(); i < problem.data.pairs.size(); ++i) {
    std::vector<float> row(nodes_.size());
    for (std::size_t j = 0; j < row.size(); ++j) {
      row[j] = static_cast<float>(pair_density(physics, problem.data.pairs[i], nodes_.p_W(j)));
    }
    if (problem.data.sight) {
      const std::vector<float> through =
          let_through(problem.data.sight->world(), physics.obstacles_per_m, problem.data.pairs[i].p_WS, surface_W_);
      for (std::size_t j = 0; j < row.size(); ++j) row[j] *= through[j];
    }
    pair_rows_.push_back(std::move(row));
  }
}

std::vector<double> ScoreMap::scores(const JointProblem& problem, const Residuals& residuals) const {
  const Viewpoints& v = problem.data.viewpoints;
  std::vector<double> per_block(blocks_.size(), 0.0), g(nodes_.size(), 0.0);
  for (std::size_t i = 0; i < block_of_viewpoint_.size(); ++i) {
    per_block[block_of_viewpoint_[i]] += v.live_s[i] * residuals.singles[i];
  }
  const auto add = [&](const std::vector<float>& row, double factor) {
    for (std::size_t j = 0; j < g.size(); ++j) g[j] += factor * row[j];
  };
  for (std::size_t b = 0; b < blocks_.size(); ++b) add(blocks_[b].kernel, per_block[b]);
  for (std::size_t i = 0; i < pair_rows_.size(); ++i) add(pair_rows_[i], residuals.pairs[i]);
  for (std::size_t d = 0; d < exposure_s_.size(); ++d) {
    for (std::size_t j = 0; j < g.size(); ++j) g[j] -= residuals.exposure[d] * exposure_s_[d][j];
  }
  return g;
}

std::vector<double> ScoreMap::corrected_sensitivity_s(const JointProblem& problem, const JointState& state) const {
  const Viewpoints& v = problem.data.viewpoints;
  const Expected sums = expected(problem, state.model, state.columns);
  std::vector<double> live_s(blocks_.size(), 0.0), counts(blocks_.size(), 0.0), S(nodes_.size(), 0.0);
  for (std::size_t i = 0; problem.config.use_singles && i < block_of_viewpoint_.size(); ++i) {
    live_s[block_of_viewpoint_[i]] += v.live_s[i];
    counts[block_of_viewpoint_[i]] += sums.singles[i];
  }
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const double others = counts[b] / problem.config.activity_min_Bq;
    for (std::size_t j = 0; live_s[b] > 0.0 && j < S.size(); ++j) {
      const double s = live_s[b] * blocks_[b].kernel[j];
      S[j] += s * s / (s + others);
    }
  }
  for (std::size_t d = 0; problem.config.use_pairs && d < exposure_s_.size(); ++d) {
    for (std::size_t j = 0; j < S.size(); ++j) S[j] += exposure_s_[d][j];
  }
  return S;
}

std::vector<ScoreMaximum> ScoreMap::maxima(const JointProblem& problem, const Residuals& residuals, int count) const {
  const std::vector<double> g = scores(problem, residuals);
  std::vector<double> pull(g.size(), 0.0);
  for (std::size_t j = 0; j < g.size(); ++j) {
    double s = problem.config.use_singles ? singles_s_[j] : 0.0;
    for (const auto& exposure_s : exposure_s_) s += problem.config.use_pairs ? exposure_s[j] : 0.0;
    pull[j] = s > 0.0 ? g[j] / std::sqrt(s) : 0.0;
  }
  std::vector<ScoreMaximum> result;
  for (std::size_t j = 0; j < g.size(); ++j) {
    const auto around = nodes_.neighbours(j);
    const bool highest = std::all_of(around.begin(), around.end(), [&](std::uint32_t i) {
      return pull[i] < pull[j] || (pull[i] == pull[j] && j < i);
    });
    if (pull[j] > 0.0 && highest) result.push_back({.p_W = nodes_.p_W(j), .score_s = g[j], .pull = pull[j]});
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const ScoreMaximum& a, const ScoreMaximum& b) { return a.pull > b.pull; });
  if (std::ssize(result) > count) result.resize(static_cast<std::size_t>(count));
  return result;
}

}  // namespace comptonaut
