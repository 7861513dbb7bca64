// SPDX-License-Identifier: BSD-3-Clause
#include "world/octree_rays.h"

#include <cmath>
#include <utility>
#include <vector>

namespace comptonaut {

std::unique_ptr<BoxTree> boxes_for_rays(const octomap::OcTree& tree, bool occupied) {
  std::vector<VoxelBox> boxes;
  const auto whole = [&](double x_m) { return static_cast<int>(std::lround(x_m / tree.getResolution())); };
  for (auto it = tree.begin_leafs(), end = tree.end_leafs(); it != end; ++it) {
    if (tree.isNodeOccupied(*it) != occupied) continue;
    const double half_m = 0.5 * it.getSize();
    const int size = whole(it.getSize());
    VoxelBox& box = boxes.emplace_back();
    box.low = {whole(it.getX() - half_m), whole(it.getY() - half_m), whole(it.getZ() - half_m)};
    for (std::size_t axis = 0; axis < 3; ++axis) box.high[axis] = box.low[axis] + size;
  }
  return boxes.empty() ? nullptr : std::make_unique<BoxTree>(tree.getResolution(), merged(std::move(boxes)));
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
