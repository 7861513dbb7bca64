// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include "core/cells.h"

namespace comptonaut {

/// Voxels from `low` to `high`, the latter not included.
struct VoxelBox {
  std::array<int, 3> low{}, high{};

  bool operator==(const VoxelBox&) const = default;
};

/// The same voxels in fewer boxes: those that share a whole face are put together.
[[nodiscard]] std::vector<VoxelBox> merged(std::vector<VoxelBox> boxes);

/// Boxes that do not overlap, laid out for rays: eight by eight in a tree, eight asked at a time.
class BoxTree {
 public:
  BoxTree(double voxel_m, std::vector<VoxelBox> boxes);

  /// Length of the straight way from a to b inside the boxes, m; once it exceeds `enough_m`, at least that. A way along
  /// a face is in the box with the greater coordinate.
  [[nodiscard]] double length_m(const Eigen::Vector3d& a_W, const Eigen::Vector3d& b_W,
                                double enough_m = std::numeric_limits<double>::infinity()) const;

  static constexpr std::size_t kLanes = 8;
  /// Corners of eight boxes, m, by axis; those that are not there are empty.
  struct Eight {
    std::array<std::array<double, kLanes>, 3> low_m, high_m;
  };

 private:
  void add_level(const std::vector<std::array<Eigen::Vector3d, 2>>& corners_m);

  std::vector<std::vector<Eight>> levels_;  ///< boxes; bounds of each eight of them; ... ; the last has one eight
};

}  // namespace comptonaut
