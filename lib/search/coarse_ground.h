// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/cells.h"

namespace comptonaut {

/// The ground in coarse squares, each with the mean place of its cells; in columns of several cells the lowest,
/// as the others are walls beside it.
class CoarseGround {
 public:
  /// Squares of edge_m, or larger ones where that would make more than squares_max (per column of cells).
  /// Throws std::invalid_argument without cells.
  CoarseGround(const Cells& cells, double edge_m, std::size_t squares_max);

  [[nodiscard]] std::size_t size() const { return p_W_.size(); }
  [[nodiscard]] double edge_m() const { return edge_m_; }
  [[nodiscard]] const Eigen::Vector3d& p_W(std::size_t i) const { return p_W_[i]; }
  /// The mean place of those of its cells that lie lowest: what is hardest to see.
  [[nodiscard]] const Eigen::Vector3d& low_W(std::size_t i) const { return low_W_[i]; }
  /// Bounds of the cells.
  [[nodiscard]] const Area& area() const { return area_; }

  /// The square below p_W; beyond the bounds and in holes the nearest one there.
  [[nodiscard]] std::size_t at(const Eigen::Vector3d& p_W) const;

 private:
  void number(const std::vector<VoxelKey>& keys);

  double edge_m_;
  Area area_;
  std::vector<Eigen::Vector3d> p_W_, low_W_;
  std::int32_t x_first_ = 0, y_first_ = 0, columns_ = 0, rows_ = 0;
  std::vector<std::uint32_t> square_at_;  ///< row by row
};

}  // namespace comptonaut
