// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/joint_map.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "radiation/cell_centres.h"
#include "radiation/map_projection.h"
#include "radiation/map_support.h"

namespace comptonaut {
namespace {

/// Each node's sum over its leaves.
std::vector<double> summed(const std::vector<GroundNode>& nodes, std::vector<double> of_leaves) {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].children > 0) of_leaves[i] = 0.0;
  }
  for (std::size_t i = nodes.size(); --i > 0;) of_leaves[nodes[i].parent] += of_leaves[i];
  return of_leaves;
}

/// Each node's sum over itself and all nodes that hold it.
void hand_down(const std::vector<GroundNode>& nodes, std::vector<double>& of_nodes) {
  for (std::size_t i = 1; i < nodes.size(); ++i) of_nodes[i] += of_nodes[nodes[i].parent];
}
void hand_down(const std::vector<GroundNode>& nodes, std::vector<NodeField>& of_nodes) {
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    const Eigen::Vector3d off_W = nodes[i].p_W - nodes[nodes[i].parent].p_W;
    of_nodes[i].add(1.0, of_nodes[nodes[i].parent].about(off_W.x(), off_W.y()));
  }
}

/// a moved on by share of its way from b, kept positive.
double moved_on(double a, double b, double share) { return std::max(a + share * (a - b), 0.1 * a); }

/// From `to` on along the way that led there from `from`.
MapState moved_on(const MapState& from, const MapState& to, double share) {
  MapState on = to;
  for (std::size_t i = 0; i < on.lambda_Bq.size(); ++i) {
    on.lambda_Bq[i] = moved_on(to.lambda_Bq[i], from.lambda_Bq[i], share);
  }
  for (std::size_t d = 0; d < on.drones.size(); ++d) {
    const DroneModel &a = to.drones[d], &b = from.drones[d];
    on.drones[d].singles_per_s = moved_on(a.singles_per_s, b.singles_per_s, share);
    on.drones[d].pairs_per_s = moved_on(a.pairs_per_s, b.pairs_per_s, share);
  }
  return on;
}

/// The step of expectation maximisation.
MapState stepped_from(MapState state, const MapProjection& at) {
  for (std::size_t i = 0; i < at.ratio.size(); ++i) state.lambda_Bq[i] *= at.ratio[i];
  for (std::size_t d = 0; d < state.drones.size(); ++d) {
    state.drones[d].singles_per_s *= at.singles_ratio[d];
    state.drones[d].pairs_per_s *= at.pairs_ratio[d];
  }
  return state;
}

}  // namespace

JointMap::JointMap(const JointMapConfig& config, const Cells& cells)
    : config_(config), cells_(&cells), rows_(cells, config.resolution) {}

void JointMap::extend(const JointPhysics& physics, const JointData& data) { rows_.extend(physics, data); }

std::vector<NodeField> JointMap::sensitivity(const JointConfig& config, const JointModel& model) const {
  const std::vector<GroundNode>& nodes = rows_.tree().nodes();
  std::vector<NodeField> s(nodes.size());
  for (std::size_t d = 0; d < model.drones.size(); ++d) {
    const double singles = config.use_singles ? model.drones[d].scale * model.scatter : 0.0;
    const double pairs = config.use_pairs ? model.drones[d].scale : 0.0;
    for (std::size_t i = 0; i < s.size(); ++i) {
      s[i].add(singles, rows_.singles_s()[d][i]);
      s[i].add(pairs, rows_.pairs_s()[d][i]);
    }
  }
  hand_down(nodes, s);
  return s;
}

/// Takes the model's scales, and spreads nodes that were split since the last update, or at the first one half of what
/// is counted over all.
void JointMap::start(const JointModel& model) {
  const std::vector<GroundNode>& nodes = rows_.tree().nodes();
  const bool first = state_.lambda_Bq.empty();
  const std::size_t known_nodes = std::max<std::size_t>(state_.lambda_Bq.size(), 1),
                    known_drones = state_.drones.size();
  state_.drones.resize(model.drones.size());
  for (std::size_t d = 0; d < state_.drones.size(); ++d) {
    if (d >= known_drones) state_.drones[d] = model.drones[d];
    state_.drones[d].scale = model.drones[d].scale;
  }
  state_.lambda_Bq.resize(nodes.size(), 0.0);
  for (std::size_t i = known_nodes; i < nodes.size(); ++i) {
    state_.lambda_Bq[i] = state_.lambda_Bq[nodes[i].parent] * nodes[i].cells / nodes[nodes[i].parent].cells;
  }
  double counted = 0.0, sensitivity_s = 0.0;
  for (const MapBlock& block : rows_.blocks()) {
    counted += static_cast<double>(block.pairs.size());
    for (const SinglesRow& row : block.singles) counted += row.counted;
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].children == 0) sensitivity_s += sensitivity_s_[i] * nodes[i].cells;
  }
  const double even_Bq = sensitivity_s > 0.0 ? counted / sensitivity_s : 0.0;
  floor_Bq_ = config_.floor_share * even_Bq;
  for (std::size_t i = 0; first && i < nodes.size(); ++i) state_.lambda_Bq[i] = 0.5 * even_Bq * nodes[i].cells;
}

/// To the floor where more would gain.
MapState JointMap::lifted(MapState state, const MapProjection& at) const {
  for (std::size_t i = 0; i < at.ratio.size(); ++i) {
    if (at.ratio[i] > 1.0) {
      state.lambda_Bq[i] = std::max(state.lambda_Bq[i], floor_Bq_ * rows_.tree().nodes()[i].cells);
    }
  }
  return state;
}

MapProjection JointMap::project(const JointProblem& problem, double scatter, const Expected& held) const {
  const std::vector<GroundNode>& nodes = rows_.tree().nodes();
  const JointData& data = problem.data;
  const std::vector<double> sums_Bq = summed(nodes, state_.lambda_Bq);
  std::vector<std::vector<double>> held_singles;
  for (const MapBlock& block : rows_.blocks()) held_singles.emplace_back(block.singles.size(), 0.0);
  for (std::size_t v = 0; v < held.singles.size(); ++v) {
    const MapRows::Place place = rows_.viewpoints()[v];
    held_singles[place.block][place.row] += held.singles[v];
  }
  MapProjection result{.ratio = std::vector<double>(nodes.size(), 0.0),
                       .singles_ratio = std::vector<double>(state_.drones.size(), 0.0),
                       .pairs_ratio = std::vector<double>(state_.drones.size(), 0.0)};
  const bool use_singles = problem.config.use_singles, use_pairs = problem.config.use_pairs;
  const std::vector<const float*> rows = rows_of(rows_.blocks(), use_singles, use_pairs);
  const auto after = [&] { return rows[std::min(result.root_curvature.size(), rows.size() - 1)]; };
  AlignedVector<double> x, u;
  for (std::size_t b = 0; b < rows_.blocks().size(); ++b) {
    const MapBlock& block = rows_.blocks()[b];
    const std::size_t n = padded(block.nodes.size());
    x.assign(n, 0.0);
    u.assign(n, 0.0);
    for (std::size_t k = 0; k < block.nodes.size(); ++k) x[k] = sums_Bq[block.nodes[k]];
    for (std::size_t r = 0; use_singles && r < block.singles.size(); ++r) {
      const SinglesRow& row = block.singles[r];
      const DroneModel& drone = state_.drones[row.drone];
      const double factor = drone.scale * scatter;
      const double mu = factor * row_dot(row.counts_per_Bq.data(), x.data(), n) + held_singles[b][r] +
                        drone.singles_per_s * row.live_s;
      result.log_likelihood -= held_singles[b][r] + drone.singles_per_s * row.live_s;
      result.root_curvature.push_back(static_cast<float>(std::sqrt(row.counted) / mu));
      if (!(row.counted > 0.0)) continue;
      result.log_likelihood += row.counted * std::log(mu);
      result.singles_ratio[row.drone] += row.counted / mu * row.live_s;
      row_spread(row.counts_per_Bq.data(), factor * row.counted / mu, u.data(), n, after());
    }
    for (std::size_t r = 0; use_pairs && r < block.pairs.size(); ++r) {
      const std::uint32_t pair = block.pairs[r];
      const DroneModel& drone = state_.drones[data.pairs[pair].drone];
      const float* row = &block.densities_per_Bq[r * n];
      const double f = drone.scale * row_dot(row, x.data(), n) + (held.pairs.empty() ? 0.0 : held.pairs[pair]) +
                       drone.pairs_per_s * kIsotropic_per_sr;
      result.log_likelihood += std::log(f);
      result.root_curvature.push_back(static_cast<float>(1.0 / f));
      result.pairs_ratio[data.pairs[pair].drone] += kIsotropic_per_sr / f;
      row_spread(row, drone.scale / f, u.data(), n, after());
    }
    for (std::size_t k = 0; k < block.nodes.size(); ++k) result.ratio[block.nodes[k]] += u[k];
  }
  hand_down(nodes, result.ratio);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].children == 0) result.log_likelihood -= sensitivity_s_[i] * state_.lambda_Bq[i];
    result.ratio[i] = sensitivity_s_[i] > 0.0 ? result.ratio[i] / sensitivity_s_[i] : 0.0;
  }
  for (std::size_t d = 0; d < state_.drones.size(); ++d) {
    const double live_s = data.live_s[d];
    if (problem.config.use_pairs) result.log_likelihood -= state_.drones[d].pairs_per_s * live_s;
    result.pairs_ratio[d] = problem.config.use_pairs && live_s > 0.0 ? result.pairs_ratio[d] / live_s : 1.0;
    result.singles_ratio[d] = problem.config.use_singles && live_s > 0.0 ? result.singles_ratio[d] / live_s : 1.0;
  }
  return result;
}

Convergence JointMap::update(const JointProblem& problem, const JointModel& model, const Expected& held) {
  sensitivity_ = sensitivity(problem.config, model);
  sensitivity_s_.clear();
  for (std::size_t i = 0; i < sensitivity_.size(); ++i) {
    sensitivity_s_.push_back(sensitivity_[i].mean(rows_.tree().nodes()[i]));
  }
  start(model);
  MapSupport support(rows_, problem, model.scatter, sensitivity_s_);
  MapProjection at = project(problem, model.scatter, held);
  Convergence result{.steps = 1, .log_likelihood = at.log_likelihood};
  MapState stepped = stepped_from(state_, at), before = stepped;
  double momentum = 1.0;
  for (bool lost = false; result.steps < config_.steps_max;) {
    std::optional<MapSupport::Step> jump;
    if (config_.accelerated && !lost) jump = support.step(state_, at, config_.gain_min);
    if (jump && jump->gain < config_.gain_min) {
      result.gain = jump->gain;
      result.reached = true;
      break;
    }
    const double next_momentum = config_.accelerated ? 0.5 * (1.0 + std::sqrt(1.0 + 4.0 * momentum * momentum)) : 1.0;
    const MapState here =
        std::exchange(state_, jump                ? std::move(jump->to)
                              : result.steps == 1 ? lifted(stepped, at)
                                                  : moved_on(before, stepped, (momentum - 1.0) / next_momentum));
    const bool safe = !jump && result.steps > 1 && momentum == 1.0;
    MapProjection next = project(problem, model.scatter, held);
    ++result.steps;
    lost = next.log_likelihood < at.log_likelihood && !safe;
    if (lost) {
      state_ = here;
      before = stepped;
      momentum = 1.0;
      continue;
    }
    momentum = jump ? 1.0 : next_momentum;
    before = std::exchange(stepped, stepped_from(state_, next));
    result.gain = next.log_likelihood - at.log_likelihood;
    result.log_likelihood = next.log_likelihood;
    at = std::move(next);
    result.reached = result.gain < config_.gain_min;
    if (result.reached) break;
  }
  return result;
}

std::vector<double> JointMap::lambda_Bq() const {
  std::vector<double> result(cells_->size(), 0.0);
  const std::vector<GroundNode>& nodes = rows_.tree().nodes();
  for (std::size_t i = 0; i < state_.lambda_Bq.size(); ++i) {
    if (nodes[i].children > 0) continue;
    for (const std::uint32_t j : rows_.tree().cells_of(nodes[i])) result[j] = state_.lambda_Bq[i] / nodes[i].cells;
  }
  return result;
}

std::vector<double> JointMap::over_cells(const std::vector<NodeField>& of_leaves) const {
  std::vector<double> result(cells_->size(), 0.0);
  const std::vector<GroundNode>& nodes = rows_.tree().nodes();
  for (std::size_t i = 0; i < of_leaves.size(); ++i) {
    if (nodes[i].children > 0) continue;
    for (const std::uint32_t j : rows_.tree().cells_of(nodes[i])) {
      const Eigen::Vector3d off_W = cells_->p_W(j) - nodes[i].p_W;
      result[j] = of_leaves[i].at(off_W.x(), off_W.y());
    }
  }
  return result;
}

std::vector<double> JointMap::sensitivity_s() const { return over_cells(sensitivity_); }

std::vector<double> JointMap::pair_sensitivity_s() const {
  std::vector<NodeField> s(rows_.tree().nodes().size());
  for (const std::vector<NodeField>& of_drone : rows_.pairs_s()) {
    for (std::size_t i = 0; i < s.size(); ++i) s[i].add(1.0, of_drone[i]);
  }
  hand_down(rows_.tree().nodes(), s);
  return over_cells(s);
}

Expected sources_only(const JointProblem& problem, JointModel model, const std::vector<ResponseColumn>& columns) {
  for (DroneModel& drone : model.drones) drone.singles_per_s = drone.pairs_per_s = 0.0;
  return expected(problem, model, columns);
}

}  // namespace comptonaut
