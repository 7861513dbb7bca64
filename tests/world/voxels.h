// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/OcTree.h>

#include <filesystem>
#include <map>

#include "core/cells.h"
#include "core/random.h"
#include "scratch.h"
#include "world/world.h"

namespace comptonaut {

/// A world the slow way: what each voxel is, unknown where there is none. The oracle for World.
struct Voxels {
  double voxel_m = 0.5;
  std::map<VoxelKey, Occupancy> known;

  [[nodiscard]] Occupancy at(VoxelKey key) const {
    const auto it = known.find(key);
    return it == known.end() ? Occupancy::kUnknown : it->second;
  }
  [[nodiscard]] Eigen::Vector3d min_W(VoxelKey key) const { return voxel_m * Eigen::Vector3d(key.x, key.y, key.z); }
  [[nodiscard]] Eigen::Vector3d centre_W(VoxelKey key) const {
    return min_W(key) + Eigen::Vector3d::Constant(0.5 * voxel_m);
  }
};

/// Lumps of all three kinds about the origin, so that the octree has leaves of several sizes.
inline Voxels random_voxels(std::uint64_t seed, int half_size) {
  Voxels voxels;
  Random random(seed);
  for (int lump = 0; lump < 60; ++lump) {
    const auto draw = [&](int size) { return static_cast<int>(random() % static_cast<std::uint64_t>(size)); };
    const VoxelKey from{draw(2 * half_size) - half_size, draw(2 * half_size) - half_size,
                        draw(2 * half_size) - half_size};
    const VoxelKey size{1 + draw(half_size), 1 + draw(half_size), 1 + draw(half_size)};
    const Occupancy kind = lump < 30 || draw(2) == 0 ? Occupancy::kFree : Occupancy::kOccupied;
    for (int x = from.x; x < std::min(half_size, from.x + size.x); ++x) {
      for (int y = from.y; y < std::min(half_size, from.y + size.y); ++y) {
        for (int z = from.z; z < std::min(half_size, from.z + size.z); ++z) voxels.known[{x, y, z}] = kind;
      }
    }
  }
  return voxels;
}

inline octomap::OcTree octree_of(const Voxels& voxels) {
  octomap::OcTree tree(voxels.voxel_m);
  for (const auto& [key, occupancy] : voxels.known) {
    const Eigen::Vector3d p_W = voxels.centre_W(key);
    tree.setNodeValue(p_W.x(), p_W.y(), p_W.z(), occupancy == Occupancy::kOccupied ? 1.5F : -0.7F, true);
  }
  tree.updateInnerOccupancy();
  return tree;
}

inline World world_of(const Voxels& voxels, const std::string& name, UnknownSpace unknown = UnknownSpace::kClosed) {
  const std::filesystem::path file = scratch_file(name);
  octree_of(voxels).writeBinary(file.string());
  return World::load(file, unknown);
}

}  // namespace comptonaut
