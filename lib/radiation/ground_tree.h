// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/cells.h"

namespace comptonaut {

/// A square of the ground with all cells whose columns are in it.
struct GroundNode {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  ///< mean of its cells' centres
  double sigma_x_m = 0.0, sigma_y_m = 0.0;        ///< their standard deviations along x and y,
  double covariance_m2 = 0.0;                     ///< and their covariance
  std::uint32_t first = 0, cells = 0;             ///< [first, first + cells) of GroundTree::order
  std::uint32_t parent = 0;                       ///< before its children; the root's is itself
  std::uint32_t child = 0;                        ///< the first of `children` nodes side by side
  std::uint8_t children = 0;                      ///< 0: not split (yet), then it is a leaf
  std::uint8_t level = 0;                         ///< its edge is 2^level cells
};

/// A quadtree over the cells, split only where somebody asked for detail: its size follows what is looked at closely,
/// not the area. Cells above one another (a steep slope) stay together in one leaf.
class GroundTree {
 public:
  /// Throws std::invalid_argument without cells.
  explicit GroundTree(const Cells& cells);

  [[nodiscard]] const std::vector<GroundNode>& nodes() const { return nodes_; }
  [[nodiscard]] std::span<const std::uint32_t> order() const { return order_; }
  [[nodiscard]] std::span<const std::uint32_t> cells_of(const GroundNode& node) const {
    return order().subspan(node.first, node.cells);
  }

  /// The ground as seen from within reach_m of p_W: nodes that together hold every cell once, each one cell wide or no
  /// wider than edge_max_m and merge_rad times its distance from there. Splits what is too wide. Those of several cells
  /// come first.
  [[nodiscard]] std::vector<std::uint32_t> seen_from(const Eigen::Vector3d& p_W, double reach_m, double merge_rad,
                                                     double edge_max_m);

 private:
  void split(std::uint32_t at);
  [[nodiscard]] std::uint64_t code(std::uint32_t cell) const;
  [[nodiscard]] GroundNode node(std::uint32_t first, std::uint32_t cells, std::uint32_t parent, int level) const;
  [[nodiscard]] double distance_m(const GroundNode& node, const Eigen::Vector3d& p_W) const;

  const Cells* cells_;
  VoxelKey lowest_;
  std::vector<std::uint32_t> order_;  ///< cells by the interlaced bits of x and y
  std::vector<GroundNode> nodes_;
};

}  // namespace comptonaut
