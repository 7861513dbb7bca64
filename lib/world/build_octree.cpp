// SPDX-License-Identifier: BSD-3-Clause
#include "world/build_octree.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace comptonaut {
namespace {

constexpr double kVoxelsMax = 5e7;
constexpr int kMiddleKey = 32'768;  // of the voxel that begins at the origin

}  // namespace

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
  const float known[] = {tree->getClampingThresMinLog(), tree->getClampingThresMaxLog()};
  const auto key = [](double i) { return static_cast<octomap::key_type>(static_cast<int>(i) + kMiddleKey); };
  for (double z = first.z(); z < end.z(); ++z) {
    for (double y = first.y(); y < end.y(); ++y) {
      for (double x = first.x(); x < end.x(); ++x) {
        const Occupancy here = at(voxel_m * Eigen::Vector3d(x + 0.5, y + 0.5, z + 0.5));
        if (here == Occupancy::kUnknown) continue;
        const float log_odds = known[here == Occupancy::kOccupied ? 1 : 0];
        tree->setNodeValue(octomap::OcTreeKey(key(x), key(y), key(z)), log_odds, true);
      }
    }
  }
  tree->updateInnerOccupancy();
  tree->prune();
  return tree;
}

}  // namespace comptonaut
