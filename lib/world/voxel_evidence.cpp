// SPDX-License-Identifier: BSD-3-Clause
#include "world/voxel_evidence.h"

#include <octomap/OcTree.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "world/build_octree.h"

namespace comptonaut {
namespace {

octomap::point3d point(const Eigen::Vector3d& p_W) {
  return {static_cast<float>(p_W.x()), static_cast<float>(p_W.y()), static_cast<float>(p_W.z())};
}

octomap::OcTreeKey tree_key(VoxelKey voxel) {
  const auto key = [](std::int32_t i) { return static_cast<octomap::key_type>(i + kMiddleKey); };
  return {key(voxel.x), key(voxel.y), key(voxel.z)};
}

VoxelKey voxel_of(const octomap::OcTreeKey& key) {
  return {int{key[0]} - kMiddleKey, int{key[1]} - kMiddleKey, int{key[2]} - kMiddleKey};
}

bool is_reached(VoxelKey voxel) {
  return std::min({voxel.x, voxel.y, voxel.z}) >= -kMiddleKey && std::max({voxel.x, voxel.y, voxel.z}) < kMiddleKey;
}

void each_once(std::vector<VoxelKey>& voxels) {
  std::ranges::sort(voxels);
  voxels.erase(std::unique(voxels.begin(), voxels.end()), voxels.end());
}

}  // namespace

VoxelEvidence::VoxelEvidence(const World& start, const VoxelEvidenceConfig& config)
    : start_(start), config_(config), tree_(std::make_unique<octomap::OcTree>(start.voxel_m())) {}
VoxelEvidence::~VoxelEvidence() = default;
VoxelEvidence::VoxelEvidence(VoxelEvidence&&) noexcept = default;
VoxelEvidence& VoxelEvidence::operator=(VoxelEvidence&&) noexcept = default;

Occupancy VoxelEvidence::at(const Eigen::Vector3d& p_W) const { return known(voxel_at(p_W, voxel_m())); }

Occupancy VoxelEvidence::known(VoxelKey voxel) const {
  const octomap::OcTreeNode* node = is_reached(voxel) ? tree_->search(tree_key(voxel)) : nullptr;
  if (node != nullptr) return tree_->isNodeOccupied(node) ? Occupancy::kOccupied : Occupancy::kFree;
  return start_at(voxel);
}

Occupancy VoxelEvidence::start_at(VoxelKey voxel) const {
  return start_.at(voxel_m() * Eigen::Vector3d(voxel.x + 0.5, voxel.y + 0.5, voxel.z + 0.5));
}

/// To the nearest place within near_m along an axis that is known to be occupied; the point itself where there is none.
Eigen::Vector3d VoxelEvidence::snapped(const Eigen::Vector3d& p_W, double near_m) const {
  if (at(p_W) == Occupancy::kOccupied) return p_W;
  const int steps = static_cast<int>(std::ceil(2.0 * near_m / voxel_m()));
  for (int i = 1; i <= steps; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const double side : {-1.0, 1.0}) {
        Eigen::Vector3d beside_W = p_W;
        beside_W[axis] += side * near_m * i / steps;
        if (at(beside_W) == Occupancy::kOccupied) return beside_W;
      }
    }
  }
  return p_W;
}

void VoxelEvidence::insert(const Eigen::Vector3d& origin_W, std::span<const Eigen::Vector3d> points_W) {
  std::vector<VoxelKey> hits, passed;
  octomap::KeyRay ray;
  for (const Eigen::Vector3d& p_W : points_W) {
    const Eigen::Vector3d way_W = p_W - origin_W;
    const double range_m = way_W.norm();
    const double near_m = kNear * std::hypot(config_.position_sigma_m, config_.attitude_sigma_rad * range_m);
    const bool hit = range_m <= config_.range_max_m;
    const double free_m = hit ? range_m - near_m : config_.range_max_m;
    if (hit) hits.push_back(voxel_at(snapped(p_W, near_m), voxel_m()));
    if (free_m <= 0.0) continue;
    const Eigen::Vector3d end_W = origin_W + free_m / range_m * way_W;
    const bool reached = is_reached(voxel_at(origin_W, voxel_m())) && is_reached(voxel_at(end_W, voxel_m()));
    if (!reached || !tree_->computeRayKeys(point(origin_W), point(end_W), ray)) continue;
    for (const octomap::OcTreeKey& key : ray) passed.push_back(voxel_of(key));
  }
  each_once(hits);
  each_once(passed);
  for (const VoxelKey& voxel : hits) update(voxel, true);
  for (const VoxelKey& voxel : passed) {
    if (!std::ranges::binary_search(hits, voxel)) update(voxel, false);
  }
}

void VoxelEvidence::update(VoxelKey voxel, bool hit) {
  if (!is_reached(voxel)) return;
  const octomap::OcTreeKey key = tree_key(voxel);
  const Occupancy before = known(voxel);
  if (tree_->search(key) == nullptr) {
    if (before == (hit ? Occupancy::kOccupied : Occupancy::kFree)) return;  // is as sure as it can be
    set_voxel(*tree_, voxel, before);
  }
  const octomap::OcTreeNode* node = tree_->updateNode(key, hit, true);
  const Occupancy now = tree_->isNodeOccupied(node) ? Occupancy::kOccupied : Occupancy::kFree;
  if (now == before) return;
  const auto taken = taken_.find(voxel);
  const Occupancy told = taken != taken_.end() ? taken->second : start_at(voxel);
  if (now == told)
    changed_.erase(voxel);
  else
    changed_[voxel] = now;
}

std::vector<VoxelChange> VoxelEvidence::take_changes(std::size_t count) {
  std::vector<VoxelChange> changes;
  for (const Occupancy kind : {Occupancy::kOccupied, Occupancy::kFree}) {
    for (auto it = changed_.begin(); it != changed_.end() && changes.size() < count;) {
      if (it->second != kind) {
        ++it;
        continue;
      }
      changes.push_back({it->first, it->second});
      taken_[it->first] = it->second;
      it = changed_.erase(it);
    }
  }
  return changes;
}

}  // namespace comptonaut
