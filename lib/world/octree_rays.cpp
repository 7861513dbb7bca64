// SPDX-License-Identifier: BSD-3-Clause
#include "world/octree_rays.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace comptonaut {

std::unique_ptr<OccupiedVoxels> voxels_for_rays(const octomap::OcTree& tree, bool occupied) {
  struct Leaf {
    VoxelKey corner;
    int size;
  };
  std::vector<Leaf> leaves;
  Eigen::Vector3i first = Eigen::Vector3i::Constant(1 << 20), last = -first;
  const auto whole = [&](double x_m) { return static_cast<std::int32_t>(std::lround(x_m / tree.getResolution())); };
  for (auto it = tree.begin_leafs(), end = tree.end_leafs(); it != end; ++it) {
    if (tree.isNodeOccupied(*it) != occupied) continue;
    const double half_m = 0.5 * it.getSize();
    const VoxelKey corner{whole(it.getX() - half_m), whole(it.getY() - half_m), whole(it.getZ() - half_m)};
    const int size = whole(it.getSize());
    first = first.cwiseMin(Eigen::Vector3i(corner.x, corner.y, corner.z));
    last = last.cwiseMax(Eigen::Vector3i(corner.x + size - 1, corner.y + size - 1, corner.z + size - 1));
    leaves.push_back({corner, size});
  }
  if (leaves.empty()) return nullptr;
  auto voxels = std::make_unique<OccupiedVoxels>(tree.getResolution(), VoxelKey{first.x(), first.y(), first.z()},
                                                 VoxelKey{last.x(), last.y(), last.z()});
  for (const Leaf& leaf : leaves) voxels->fill(leaf.corner, leaf.size);
  return voxels;
}

std::optional<double> range_m(const octomap::OcTree& tree, const Eigen::Vector3d& p_W,
                              const Eigen::Vector3d& direction_W, double max_m) {
  const auto point = [](const Eigen::Vector3f& v) { return octomap::point3d(v.x(), v.y(), v.z()); };
  const octomap::point3d from = point(p_W.cast<float>()), direction = point(direction_W.normalized().cast<float>());
  const octomap::OcTreeNode* here = tree.search(from);
  if (here != nullptr && tree.isNodeOccupied(here)) return 0.0;
  octomap::point3d voxel, face;
  if (!tree.castRay(from, direction, voxel, true, max_m + 2.0 * tree.getResolution())) return std::nullopt;
  if (!tree.getRayIntersection(from, direction, voxel, face)) face = voxel;
  const double range_m = (face - from).norm();
  return range_m <= max_m ? std::optional(range_m) : std::nullopt;
}

}  // namespace comptonaut
