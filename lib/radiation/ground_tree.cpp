// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/ground_tree.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace comptonaut {
namespace {

/// Nodes of more cells are split at once, so that no later split takes long.
constexpr std::uint32_t kCellsToLookAt = 4096;

/// Bit k of x at place 2 k.
std::uint64_t spaced(std::uint32_t x) {
  std::uint64_t bits = x;
  bits = (bits | bits << 16) & 0x0000ffff0000ffff;
  bits = (bits | bits << 8) & 0x00ff00ff00ff00ff;
  bits = (bits | bits << 4) & 0x0f0f0f0f0f0f0f0f;
  bits = (bits | bits << 2) & 0x3333333333333333;
  return (bits | bits << 1) & 0x5555555555555555;
}

}  // namespace

GroundTree::GroundTree(const Cells& cells) : cells_(&cells) {
  if (cells.size() == 0) throw std::invalid_argument("a ground without cells");
  lowest_ = cells.key(0);
  for (std::size_t j = 0; j < cells.size(); ++j) {
    lowest_.x = std::min(lowest_.x, cells.key(j).x);
    lowest_.y = std::min(lowest_.y, cells.key(j).y);
  }
  std::vector<std::pair<std::uint64_t, std::uint32_t>> by_code;
  by_code.reserve(cells.size());
  for (std::uint32_t j = 0; j < cells.size(); ++j) by_code.emplace_back(code(j), j);
  std::sort(by_code.begin(), by_code.end());
  order_.reserve(cells.size());
  for (const auto& [at, j] : by_code) order_.push_back(j);
  int level = 0;
  while (by_code.back().first >> (2 * level) > 0) ++level;
  nodes_.push_back(node(0, static_cast<std::uint32_t>(cells.size()), 0, level));
  for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
    if (nodes_[i].cells > kCellsToLookAt) split(i);
  }
}

std::uint64_t GroundTree::code(std::uint32_t cell) const {
  const VoxelKey key = cells_->key(cell);
  return spaced(static_cast<std::uint32_t>(key.x - lowest_.x)) | spaced(static_cast<std::uint32_t>(key.y - lowest_.y))
                                                                     << 1;
}

GroundNode GroundTree::node(std::uint32_t first, std::uint32_t cells, std::uint32_t parent, int level) const {
  Eigen::Vector3d sum_W = Eigen::Vector3d::Zero();
  for (std::uint32_t i = first; i < first + cells; ++i) sum_W += cells_->p_W(order_[i]);
  const Eigen::Vector3d mean_W = sum_W / cells;
  Eigen::Vector3d squares_m2 = Eigen::Vector3d::Zero();
  double products_m2 = 0.0;
  for (std::uint32_t i = first; i < first + cells; ++i) {
    const Eigen::Vector3d off_W = cells_->p_W(order_[i]) - mean_W;
    squares_m2 += off_W.cwiseAbs2();
    products_m2 += off_W.x() * off_W.y();
  }
  return {.p_W = mean_W,
          .sigma_x_m = std::sqrt(squares_m2.x() / cells),
          .sigma_y_m = std::sqrt(squares_m2.y() / cells),
          .covariance_m2 = products_m2 / cells,
          .first = first,
          .cells = cells,
          .parent = parent,
          .level = static_cast<std::uint8_t>(level)};
}

void GroundTree::split(std::uint32_t at) {
  const GroundNode parent = nodes_[at];
  nodes_[at].child = static_cast<std::uint32_t>(nodes_.size());
  const std::uint32_t last = parent.first + parent.cells;
  for (std::uint32_t first = parent.first; first < last;) {
    const std::uint64_t next = (code(order_[first]) >> (2 * (parent.level - 1))) + 1;
    const auto end = std::partition_point(order_.begin() + first, order_.begin() + last, [&](std::uint32_t cell) {
      return code(cell) >> (2 * (parent.level - 1)) < next;
    });
    const auto cells = static_cast<std::uint32_t>(end - order_.begin()) - first;
    nodes_.push_back(node(first, cells, at, parent.level - 1));
    ++nodes_[at].children;
    first += cells;
  }
}

/// To the nearest point of the node's square.
double GroundTree::distance_m(const GroundNode& node, const Eigen::Vector3d& p_W) const {
  const VoxelKey key = cells_->key(order_[node.first]);
  const double cell_m = cells_->cell_m(), half_m = 0.5 * cell_m * std::exp2(node.level);
  const auto off_m = [&](std::int32_t k, std::int32_t lowest, double at_m) {
    const double low_m = cell_m * (((k - lowest) >> node.level << node.level) + lowest);
    return std::max(std::abs(at_m - low_m - half_m) - half_m, 0.0);
  };
  const double dx = off_m(key.x, lowest_.x, p_W.x()), dy = off_m(key.y, lowest_.y, p_W.y()),
               dz = p_W.z() - node.p_W.z();
  return std::sqrt(dx * dx + dy * dy + dz * dz);
}

std::vector<std::uint32_t> GroundTree::seen_from(const Eigen::Vector3d& p_W, double reach_m, double merge_rad,
                                                 double edge_max_m) {
  std::vector<std::uint32_t> merged, single, open = {0};
  while (!open.empty()) {
    const std::uint32_t at = open.back();
    open.pop_back();
    const GroundNode& seen = nodes_[at];
    const double edge_m = cells_->cell_m() * std::exp2(seen.level);
    const bool small = seen.cells == 1 || seen.level == 0;
    if (small || edge_m <= std::min(merge_rad * (distance_m(seen, p_W) - reach_m), edge_max_m)) {
      (seen.cells == 1 ? single : merged).push_back(at);
      continue;
    }
    if (seen.children == 0) split(at);
    for (std::uint32_t i = nodes_[at].children; i > 0; --i) open.push_back(nodes_[at].child + i - 1);
  }
  std::vector<std::uint32_t> all;  // to be kept for long: no larger than it must be
  all.reserve(merged.size() + single.size());
  all.insert(all.end(), merged.begin(), merged.end());
  all.insert(all.end(), single.begin(), single.end());
  return all;
}

}  // namespace comptonaut
