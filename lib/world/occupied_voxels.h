// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/cells.h"

namespace comptonaut {

/// Which voxels are occupied, laid out for rays: bricks of 8 x 8 x 8 voxels, of which those that are empty or full take
/// no memory of their own. Filled once, then only asked.
class OccupiedVoxels {
 public:
  /// Voxels from `first` to `last`, both included. Throws std::invalid_argument where those are too many for memory.
  OccupiedVoxels(double voxel_m, VoxelKey first, VoxelKey last);

  /// Marks a cube of `size` voxels an edge as occupied.
  void fill(VoxelKey corner, int size);

  /// Length of the straight way from a to b inside occupied voxels, m; once it exceeds `enough_m`, at least that. A way
  /// along the face of a voxel is in the voxel with the greater coordinate.
  [[nodiscard]] double length_m(const Eigen::Vector3d& a_W, const Eigen::Vector3d& b_W,
                                double enough_m = std::numeric_limits<double>::infinity()) const;

 private:
  static constexpr std::uint32_t kEmpty = 0, kFull = 1;

  [[nodiscard]] bool occupied(const Eigen::Vector3i& at) const;
  /// Share of the way in occupied voxels between two shares of it; once it exceeds `enough`, at least that.
  [[nodiscard]] double inside(const Eigen::Vector3d& a_W, const Eigen::Vector3d& way_W, double begin, double end,
                              double enough) const;
  void fill_brick(const Eigen::Vector3i& brick, const Eigen::Vector3i& low, const Eigen::Vector3i& high);
  [[nodiscard]] std::size_t index(const Eigen::Vector3i& brick) const;

  double voxel_m_;
  Eigen::Vector3i first_, size_, bricks_;           ///< voxels, voxels, bricks
  std::vector<double> top_m_;                       ///< of each column of bricks: nothing is occupied above
  std::vector<std::uint32_t> brick_at_;             ///< kEmpty, kFull, or index into bits_ + 2
  std::vector<std::array<std::uint64_t, 8>> bits_;  ///< [z] bit 8 y + x
};

}  // namespace comptonaut
