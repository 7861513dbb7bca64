// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "core/cells.h"
#include "world/world.h"

namespace octomap {
class OcTree;
}

namespace comptonaut {

struct VoxelEvidenceConfig {
  double range_max_m = 30.0;          ///< further points say that the way so far is free, and no more
  double position_sigma_m = 0.05;     ///< of points beside their true place: sensor and position together
  double attitude_sigma_rad = 0.017;  ///< and this times the range
};

/// What range points say about voxels, against what was known at the start: log odds of being occupied that each scan
/// raises where points lie and lowers where rays pass, between bounds, as OctoMap does it [Hornung et al. 2013]. What
/// the start calls free or occupied begins at those bounds, so it takes three points to call a free voxel occupied and
/// nine rays to call an occupied one free. Each voxel counts once a scan, points before rays.
///
/// A point within kNear sigma of what is known to be occupied is a point of that: else poses that tilt would raise the
/// ground and thicken walls. The same last piece of its ray says nothing.
class VoxelEvidence {
 public:
  static constexpr double kNear = 2.0;

  VoxelEvidence(const World& start, const VoxelEvidenceConfig& config);
  ~VoxelEvidence();
  VoxelEvidence(VoxelEvidence&&) noexcept;
  VoxelEvidence& operator=(VoxelEvidence&&) noexcept;

  /// One scan: rays from the sensor's place to finite points.
  void insert(const Eigen::Vector3d& origin_W, std::span<const Eigen::Vector3d> points_W);

  [[nodiscard]] Occupancy at(const Eigen::Vector3d& p_W) const;
  /// Voxels that are otherwise than they were when they were last taken (at first: at the start), at most `count`,
  /// occupied ones first, then by key; the rest stays for the next time.
  [[nodiscard]] std::vector<VoxelChange> take_changes(std::size_t count);
  [[nodiscard]] std::size_t changes() const { return changed_.size(); }
  [[nodiscard]] double voxel_m() const { return start_.voxel_m(); }

 private:
  [[nodiscard]] Eigen::Vector3d snapped(const Eigen::Vector3d& p_W, double near_m) const;
  [[nodiscard]] Occupancy known(VoxelKey voxel) const;
  [[nodiscard]] Occupancy start_at(VoxelKey voxel) const;
  void update(VoxelKey voxel, bool hit);

  World start_;
  VoxelEvidenceConfig config_;
  std::unique_ptr<octomap::OcTree> tree_;  ///< of voxels that rays met
  std::map<VoxelKey, Occupancy> taken_;    ///< what was said of each
  std::map<VoxelKey, Occupancy> changed_;  ///< what is to be said
};

}  // namespace comptonaut
