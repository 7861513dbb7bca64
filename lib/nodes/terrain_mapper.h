// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "core/batch_key.h"
#include "nodes/pose_buffer.h"
#include "nodes/range_points.h"
#include "nodes/status.h"
#include "nodes/terrain_tile.h"
#include "world/voxel_evidence.h"

namespace comptonaut {

struct TerrainMapperConfig {
  VoxelEvidenceConfig evidence;
  double period_s = 1.0;  ///< of data time, between tiles
  int tiles_max = 8;      ///< each time; what finds no room waits, obstacles go first
};

/// What one MAV's range points find to be otherwise than its starting map says, as tiles for the team.
/// Points wait until poses enclose their time; pose_wait_us after it they are given up.
class TerrainMapper {
 public:
  TerrainMapper(const World& start, const TerrainMapperConfig& config, Utime pose_wait_us);

  /// Keeps a scan until its pose is known. Points that are no numbers or lie beyond the sensor's range are left out.
  void on_points(const RangePoints& points);
  /// Takes in the scans whose pose is known by now.
  void on_poses(const PoseBuffer& poses, Utime newest_pose);

  /// What has changed, where the last tiles are period_s old: numbered from next_key.number on, which it moves.
  /// `utime`: end of the batch that went before them.
  [[nodiscard]] std::vector<TerrainTile> take_tiles(Utime utime, BatchKey& next_key);

  [[nodiscard]] std::vector<Counter> counters() const;

 private:
  void insert(const RangePoints& points, const StampedPose& pose);

  TerrainMapperConfig config_;
  Utime pose_wait_us_;
  VoxelEvidence evidence_;
  std::deque<RangePoints> waiting_;
  std::optional<Utime> tiles_utime_;
  struct Counts {
    std::int64_t scans = 0, scans_without_pose = 0, points_used = 0, points_refused = 0, tiles = 0, voxels = 0;
  } counts_;
};

}  // namespace comptonaut
