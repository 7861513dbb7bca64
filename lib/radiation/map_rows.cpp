// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/map_rows.h"

#include <algorithm>
#include <cmath>

#include "radiation/view_response.h"

namespace comptonaut {
namespace {

/// What the air along a merged node's edge may absorb of 1: a polynomial of second degree follows no more.
constexpr double kAbsorbed = 0.2;

std::size_t row_of(MapBlock& block, int drone) {
  const auto at = std::find_if(block.singles.begin(), block.singles.end(),
                               [drone](const SinglesRow& row) { return row.drone == drone; });
  const auto row = static_cast<std::size_t>(at - block.singles.begin());
  if (at == block.singles.end()) {
    block.singles.push_back({.drone = drone, .counts_per_Bq = AlignedVector<float>(padded(block.nodes.size()), 0.0F)});
  }
  return row;
}

}  // namespace

std::vector<const float*> rows_of(const std::vector<MapBlock>& blocks, bool singles, bool pairs) {
  std::vector<const float*> rows;
  for (const MapBlock& block : blocks) {
    for (std::size_t r = 0; singles && r < block.singles.size(); ++r) {
      rows.push_back(block.singles[r].counts_per_Bq.data());
    }
    const std::size_t n = padded(block.nodes.size());
    for (std::size_t r = 0; pairs && r < block.pairs.size(); ++r) rows.push_back(&block.densities_per_Bq[r * n]);
  }
  return rows;
}

MapRows::MapRows(const Cells& cells, const MapResolution& resolution)
    : resolution_(resolution), cells_(&cells), tree_(cells) {}

std::size_t MapRows::block_at(const Eigen::Vector3d& p_W) {
  const double edge_m = resolution_.block_m;
  const VoxelKey key = voxel_at(p_W, edge_m);
  const auto [at, fresh] = block_at_.emplace(key, blocks_.size());
  if (fresh) {
    const Eigen::Vector3d middle_W = edge_m * Eigen::Vector3d(key.x + 0.5, key.y + 0.5, key.z + 0.5);
    blocks_.push_back(
        {.nodes = tree_.seen_from(middle_W, 0.5 * std::sqrt(3.0) * edge_m, resolution_.merge_rad, node_max_m_)});
    if (sight_) blocks_.back().let_through = let_through(blocks_.back().nodes, middle_W);
  }
  return at->second;
}

/// Of a node of many cells the mean over some of them.
std::vector<float> MapRows::let_through(const std::vector<std::uint32_t>& nodes, const Eigen::Vector3d& eye_W) const {
  constexpr std::uint32_t kLookedAt = 4;
  std::vector<float> shares;
  for (const std::uint32_t at : nodes) {
    const std::span<const std::uint32_t> cells = tree_.cells_of(tree_.nodes()[at]);
    const std::size_t n = std::min<std::size_t>(kLookedAt, cells.size());
    float sum = 0.0F;
    for (std::size_t k = 0; k < n; ++k) {
      const std::uint32_t cell = cells[(2 * k + 1) * cells.size() / (2 * n)];
      sum += comptonaut::let_through(sight_->world(), obstacles_per_m_, cells_->p_W(cell), eye_W);
    }
    shares.push_back(sum / static_cast<float>(n));
  }
  return shares;
}

MapRows::Place MapRows::place_of(const Viewpoints& viewpoints, std::size_t at) {
  const std::size_t block = block_at({viewpoints.x_m[at], viewpoints.y_m[at], viewpoints.z_m[at]});
  return {.block = block, .row = row_of(blocks_[block], viewpoints.drone[at])};
}

/// Viewpoints of one drone in one block of air.
void MapRows::add_singles(const JointPhysics& physics, const Viewpoints& viewpoints, const Place& place,
                          std::span<const std::size_t> of) {
  MapBlock& block = blocks_[place.block];
  SinglesRow& row = block.singles[place.row];
  const NodePoints points(tree_, block.nodes, 3);
  PointSums sums(points);
  for (const std::size_t at : of) {
    row.live_s += viewpoints.live_s[at];
    row.counted += viewpoints.singles[at];
    sums.add(physics, points, eye_of(viewpoints, at, physics.attenuation_per_m), viewpoints.live_s[at]);
  }
  std::vector<NodeField> singles_s = fitted(points, sums.single), pairs_s = fitted(points, sums.pair);
  for (std::size_t k = 0; k < block.let_through.size(); ++k) {
    singles_s[k] *= block.let_through[k];
    pairs_s[k] *= block.let_through[k];
  }
  for (std::size_t k = 0; k < block.nodes.size(); ++k) {
    const std::uint32_t node = block.nodes[k];
    row.counts_per_Bq[k] += static_cast<float>(singles_s[k].mean(tree_.nodes()[node]));
    singles_s_[row.drone][node].add(1.0, singles_s[k]);
    pairs_s_[row.drone][node].add(1.0, pairs_s[k]);
  }
}

/// Pairs whose photons scattered in one block of air.
void MapRows::add_pairs(const JointPhysics& physics, const JointData& data, MapBlock& block,
                        std::span<const std::size_t> of) {
  const NodePoints points(tree_, block.nodes, 2);
  block.densities_per_Bq.reserve((block.pairs.size() + of.size()) * padded(block.nodes.size()));
  for (const std::size_t at : of) {
    std::vector<double> density = node_density(physics, points, data.pairs[at]);
    for (std::size_t k = 0; k < block.let_through.size(); ++k) density[k] *= block.let_through[k];
    block.pairs.push_back(static_cast<std::uint32_t>(at));
    block.densities_per_Bq.insert(block.densities_per_Bq.end(), density.begin(), density.end());
    block.densities_per_Bq.resize(block.pairs.size() * padded(density.size()), 0.0F);
  }
}

/// What blocks see stays as it is.
void MapRows::forget_rows() {
  for (MapBlock& block : blocks_) {
    block.singles.clear();
    block.pairs.clear();
    block.densities_per_Bq.clear();
  }
  viewpoints_.clear();
  pairs_ = 0;
  singles_s_.clear();
  pairs_s_.clear();
  R_ND_.clear();
}

void MapRows::extend(const JointPhysics& physics, const JointData& data) {
  sight_ = data.sight;
  obstacles_per_m_ = physics.obstacles_per_m;
  node_max_m_ = kAbsorbed / physics.attenuation_per_m;
  const auto turned = [&](std::size_t d) {
    return Eigen::AngleAxisd(R_ND_[d].transpose() * data.R_ND[d]).angle() > kTurnKept_rad;
  };
  for (std::size_t d = 0; d < R_ND_.size(); ++d) {
    if (turned(d)) forget_rows();
  }
  R_ND_.insert(R_ND_.end(), data.R_ND.begin() + static_cast<std::ptrdiff_t>(R_ND_.size()), data.R_ND.end());
  std::map<Place, std::vector<std::size_t>> singles;
  while (viewpoints_.size() < data.viewpoints.size()) {
    viewpoints_.push_back(place_of(data.viewpoints, viewpoints_.size()));
    singles[viewpoints_.back()].push_back(viewpoints_.size() - 1);
  }
  std::map<std::size_t, std::vector<std::size_t>> pairs;
  for (; pairs_ < data.pairs.size(); ++pairs_) pairs[block_at(data.pairs[pairs_].p_WS)].push_back(pairs_);
  for (auto* all : {&singles_s_, &pairs_s_}) {
    all->resize(data.live_s.size());
    for (std::vector<NodeField>& s : *all) s.resize(tree_.nodes().size());
  }
  for (const auto& [place, of] : singles) add_singles(physics, data.viewpoints, place, of);
  for (const auto& [block, of] : pairs) add_pairs(physics, data, blocks_[block], of);
}

}  // namespace comptonaut
