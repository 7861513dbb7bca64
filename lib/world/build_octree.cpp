// SPDX-License-Identifier: BSD-3-Clause
#include "world/build_octree.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace comptonaut {
namespace {

constexpr double kVoxelsMax = 5e7;

/// Deletes the leaf of a known voxel below `node`, cutting larger leaves into their voxels; true: `node` holds nothing
/// else, and is a leaf itself so that it can be deleted. OcTree::deleteNode() fails on an inner node that gets empty.
bool forget_leaf(octomap::OcTree& tree, octomap::OcTreeNode* node, const octomap::OcTreeKey& at, unsigned depth) {
  const unsigned below = tree.getTreeDepth() - depth;
  if (below == 0) return true;
  if (!tree.nodeHasChildren(node)) tree.expandNode(node);
  const unsigned i = octomap::computeChildIdx(at, static_cast<int>(below) - 1);
  if (!forget_leaf(tree, tree.getNodeChild(node, i), at, depth + 1)) return false;
  const float log_odds = tree.getNodeChild(node, i)->getLogOdds();
  tree.deleteNodeChild(node, i);
  if (tree.nodeHasChildren(node)) return false;
  for (unsigned k = 0; k < 8; ++k) tree.createNodeChild(node, k)->setLogOdds(log_odds);
  tree.pruneNode(node);
  return true;
}

}  // namespace

void set_voxel(octomap::OcTree& tree, VoxelKey voxel, Occupancy occupancy) {
  for (const int i : {voxel.x, voxel.y, voxel.z}) {
    if (i >= -kMiddleKey && i < kMiddleKey) continue;
    throw std::invalid_argument(fmt::format("no map reaches to voxel ({}, {}, {})", voxel.x, voxel.y, voxel.z));
  }
  const auto key = [](int i) { return static_cast<octomap::key_type>(i + kMiddleKey); };
  const octomap::OcTreeKey at(key(voxel.x), key(voxel.y), key(voxel.z));
  if (occupancy != Occupancy::kUnknown) {
    const bool occupied = occupancy == Occupancy::kOccupied;
    tree.setNodeValue(at, occupied ? tree.getClampingThresMaxLog() : tree.getClampingThresMinLog(), true);
  } else if (tree.search(at) != nullptr && forget_leaf(tree, tree.getRoot(), at, 0)) {
    tree.clear();
  }
}

std::unique_ptr<octomap::OcTree> build_octree(const Box& extent, double voxel_m,
                                              const std::function<Occupancy(const Eigen::Vector3d& p_W)>& at) {
  const Eigen::Vector3d size_m = extent.max_W - extent.min_W;
  if (!(voxel_m >= 0.01 && voxel_m <= 10.0) || !(size_m.array() > 0.0).all()) {
    throw std::invalid_argument(
        fmt::format("no map of {} x {} x {} m in voxels of {} m", size_m.x(), size_m.y(), size_m.z(), voxel_m));
  }
  const Eigen::Vector3d first = (extent.min_W / voxel_m).array().round(),
                        end = (extent.max_W / voxel_m).array().round();
  const bool reaches = first.minCoeff() >= -kMiddleKey && end.maxCoeff() <= kMiddleKey;
  if (!reaches || (end - first).prod() > kVoxelsMax) {
    throw std::invalid_argument(fmt::format("a map of {} x {} x {} m has too many voxels of {} m, {:.0e} are the most",
                                            size_m.x(), size_m.y(), size_m.z(), voxel_m, kVoxelsMax));
  }
  auto tree = std::make_unique<octomap::OcTree>(voxel_m);
  for (double z = first.z(); z < end.z(); ++z) {
    for (double y = first.y(); y < end.y(); ++y) {
      for (double x = first.x(); x < end.x(); ++x) {
        const VoxelKey voxel{static_cast<int>(x), static_cast<int>(y), static_cast<int>(z)};
        set_voxel(*tree, voxel, at(voxel_m * Eigen::Vector3d(x + 0.5, y + 0.5, z + 0.5)));
      }
    }
  }
  tree->updateInnerOccupancy();
  tree->prune();
  return tree;
}

}  // namespace comptonaut
