// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/OcTree.h>

#include <Eigen/Core>
#include <functional>
#include <memory>

#include "core/cells.h"
#include "world/world.h"

namespace comptonaut {

/// What `at` says of each voxel's centre within `extent`; all else stays unknown.
/// Throws std::invalid_argument where the extent is not a box, the voxels are not 0.01 to 10 m, or more than 5e7.
[[nodiscard]] std::unique_ptr<octomap::OcTree> build_octree(
    const Box& extent, double voxel_m, const std::function<Occupancy(const Eigen::Vector3d& p_W)>& at);

/// OctoMap's key of the voxel that begins at the origin, along each axis.
inline constexpr int kMiddleKey = 32'768;

/// Makes one of the tree's smallest voxels free or occupied at full certainty, or forgets it. Inner nodes are left as
/// they are: updateInnerOccupancy() and prune() when all is done. Throws std::invalid_argument outside the tree.
void set_voxel(octomap::OcTree& tree, VoxelKey voxel, Occupancy occupancy);

}  // namespace comptonaut
