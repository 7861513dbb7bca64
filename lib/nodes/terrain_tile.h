// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "core/batch_key.h"
#include "core/time.h"
#include "world/world.h"

namespace comptonaut {

/// Voxels of the team's map that one MAV's range points found to be otherwise than before: what fits one datagram.
/// Means something alone. Its number is of one sequence with the mapper's measurement batches, and its time is the end
/// of the batch before it, so that a basis names both kinds.
struct TerrainTile {
  BatchKey key;
  Utime utime = 0;
  double voxel_m = 0.0;
  std::vector<VoxelChange> voxels;  ///< within 127 voxels of the first one

  [[nodiscard]] Utime end_utime() const { return utime; }
};

/// 1,200 bytes with the trailer of the team bus have room for 264.
inline constexpr std::size_t kMaxVoxelsPerTile = 256;

[[nodiscard]] inline Eigen::Vector3d centre_of(const VoxelKey& voxel, double voxel_m) {
  return voxel_m * Eigen::Vector3d(voxel.x + 0.5, voxel.y + 0.5, voxel.z + 0.5);
}

/// Whether a voxel can stand in a tile whose first voxel is `origin`: their distance is sent as bytes.
[[nodiscard]] inline bool fits_tile(const VoxelKey& voxel, const VoxelKey& origin) {
  const auto near = [](std::int32_t i, std::int32_t first) { return std::abs(std::int64_t{i} - first) <= 127; };
  return near(voxel.x, origin.x) && near(voxel.y, origin.y) && near(voxel.z, origin.z);
}

}  // namespace comptonaut
