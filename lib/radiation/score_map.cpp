// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/score_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/simd.h"
#include "radiation/map_projection.h"
#include "radiation/sight_lines.h"
#include "radiation/view.h"
#include "radiation/view_response.h"

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

/// t *= let_through, where that is not empty.
void shade(double* t, std::span<const float> let_through, std::size_t first, std::size_t n) {
  for (std::size_t i = 0; !let_through.empty() && i < n; ++i) t[i] *= let_through[first + i];
}

/// S += s^2 / (s + others), s = live_s kernel
COMPTONAUT_SIMD_CLONES
void add_corrected(const float* __restrict kernel, double live_s, double others, std::size_t n, double* __restrict S) {
  for (std::size_t j = 0; j < n; ++j) {
    const double s = live_s * kernel[j];
    S[j] += s * s / (s + others);
  }
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
    : nodes_(nodes_of(cells, spacing_m)),
      centres_(nodes_),
      surface_W_(nearest_cells(nodes_, cells)),
      singles_s_(nodes_.size(), 0.0) {}

std::size_t ScoreMap::block_of(const JointProblem& problem, std::size_t viewpoint) {
  const Viewpoints& v = problem.data.viewpoints;
  const VoxelKey key = voxel_at({v.x_m[viewpoint], v.y_m[viewpoint], v.z_m[viewpoint]}, kBlock_m);
  const auto [at, fresh] = block_at_.emplace(key, blocks_.size());
  if (!fresh) return at->second;
  // As if the viewpoint stood in the middle of its block, turned as it is.
  Eye eye = eye_of(v, viewpoint, problem.physics.attenuation_per_m);
  eye.p_W.head<2>() = kBlock_m * Eigen::Vector2d(key.x + 0.5, key.y + 0.5);
  Block block;
  if (problem.data.sight) {
    block.let_through = let_through(problem.data.sight->world(), problem.physics.obstacles_per_m, eye.p_W, surface_W_);
  }
  block.kernel.resize(padded(nodes_.size()), 0.0F);
  std::array<double, kChunk> of_singles, of_pairs;
  for_each_chunk(centres_, eye, [&](const View& view, std::size_t first, std::size_t n) {
    respond(problem.physics.response, view, n, of_singles.data(), of_pairs.data());
    multiply(of_singles.data(), view.weight_per_m2.data(), n);
    shade(of_singles.data(), block.let_through, first, n);
    std::copy_n(of_singles.begin(), n, block.kernel.begin() + static_cast<std::ptrdiff_t>(first));
  });
  blocks_.push_back(std::move(block));
  return at->second;
}

void ScoreMap::add_viewpoint(const JointPhysics& physics, const Viewpoints& v, std::size_t at) {
  const std::vector<float>& through = blocks_[block_of_viewpoint_[at]].let_through;
  std::vector<double>& exposure_s = exposure_s_[v.drone[at]];
  std::array<double, kChunk> of_singles, of_pairs;
  for_each_chunk(centres_, eye_of(v, at, physics.attenuation_per_m),
                 [&](const View& view, std::size_t first, std::size_t n) {
                   respond(physics.response, view, n, of_singles.data(), of_pairs.data());
                   shade(of_singles.data(), through, first, n);
                   shade(of_pairs.data(), through, first, n);
                   accumulate(of_singles.data(), view.weight_per_m2.data(), v.live_s[at], &singles_s_[first], n);
                   accumulate(of_pairs.data(), view.weight_per_m2.data(), v.live_s[at], &exposure_s[first], n);
                 });
}

void ScoreMap::add_pair(const JointProblem& problem, const Pair& pair) {
  const JointPhysics& physics = problem.physics;
  std::vector<float> through, row(padded(nodes_.size()), 0.0F);
  if (problem.data.sight) {
    through = let_through(problem.data.sight->world(), physics.obstacles_per_m, pair.p_WS, surface_W_);
  }
  std::array<double, kChunk> density;
  const Eye eye{.p_W = pair.p_WS, .R_DW = pair.R_DW, .attenuation_per_m = physics.attenuation_per_m};
  for_each_chunk(centres_, eye, [&](const View& view, std::size_t first, std::size_t n) {
    pair_densities(physics, pair, view, n, density.data());
    shade(density.data(), through, first, n);
    std::copy_n(density.begin(), n, row.begin() + static_cast<std::ptrdiff_t>(first));
  });
  pair_rows_.push_back(std::move(row));
}

void ScoreMap::extend(const JointProblem& problem) {
  const JointData& data = problem.data;
  exposure_s_.resize(data.live_s.size(), std::vector<double>(nodes_.size(), 0.0));
  while (block_of_viewpoint_.size() < data.viewpoints.size()) {
    block_of_viewpoint_.push_back(block_of(problem, block_of_viewpoint_.size()));
    add_viewpoint(problem.physics, data.viewpoints, block_of_viewpoint_.size() - 1);
  }
  while (pair_rows_.size() < data.pairs.size()) add_pair(problem, data.pairs[pair_rows_.size()]);
}

std::vector<double> ScoreMap::scores(const JointProblem& problem, const Residuals& residuals) const {
  const Viewpoints& v = problem.data.viewpoints;
  std::vector<double> per_block(blocks_.size(), 0.0), g(padded(nodes_.size()), 0.0);
  for (std::size_t i = 0; i < block_of_viewpoint_.size(); ++i) {
    per_block[block_of_viewpoint_[i]] += v.live_s[i] * residuals.singles[i];
  }
  const auto add = [&](const std::vector<float>& row, double factor, const float* next) {
    row_spread(row.data(), factor, g.data(), g.size(), next);
  };
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    add(blocks_[b].kernel, per_block[b], blocks_[std::min(b + 1, blocks_.size() - 1)].kernel.data());
  }
  for (std::size_t i = 0; i < pair_rows_.size(); ++i) {
    add(pair_rows_[i], residuals.pairs[i], pair_rows_[std::min(i + 1, pair_rows_.size() - 1)].data());
  }
  g.resize(nodes_.size());
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
    if (live_s[b] > 0.0) add_corrected(blocks_[b].kernel.data(), live_s[b], others, S.size(), S.data());
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
