// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/terrain_mapper.h"

#include <cmath>
#include <span>
#include <utility>

namespace comptonaut {
namespace {

/// Of scans that wait for poses: what a sensor of 20 Hz sends in 5 s.
constexpr std::size_t kMaxWaiting = 100;

/// In the order of the changes; each tile as full as datagrams and bytes allow.
std::vector<TerrainTile> in_tiles(std::span<const VoxelChange> changes, double voxel_m) {
  std::vector<TerrainTile> tiles;
  for (const VoxelChange& change : changes) {
    const bool fits = !tiles.empty() && tiles.back().voxels.size() < kMaxVoxelsPerTile &&
                      fits_tile(change.voxel, tiles.back().voxels.front().voxel);
    if (!fits) tiles.push_back({.key = {}, .utime = 0, .voxel_m = voxel_m, .voxels = {}});
    tiles.back().voxels.push_back(change);
  }
  return tiles;
}

}  // namespace

TerrainMapper::TerrainMapper(const World& start, const TerrainMapperConfig& config, Utime pose_wait_us)
    : config_(config), pose_wait_us_(pose_wait_us), evidence_(start, config.evidence) {}

void TerrainMapper::on_points(const RangePoints& points) {
  if (waiting_.size() >= kMaxWaiting) {
    waiting_.pop_front();
    ++counts_.scans_without_pose;
  }
  waiting_.push_back(points);
}

void TerrainMapper::on_poses(const PoseBuffer& poses, Utime newest_pose) {
  std::erase_if(waiting_, [&](const RangePoints& points) {
    const auto pose = poses.at(points.utime);
    if (pose) insert(points, *pose);
    const bool too_old = newest_pose - points.utime > pose_wait_us_;
    if (!pose && too_old) ++counts_.scans_without_pose;
    return pose || too_old;
  });
}

void TerrainMapper::insert(const RangePoints& points, const StampedPose& pose) {
  const Eigen::Isometry3d X_WB = pose.X_WB();
  std::vector<Eigen::Vector3d> points_W;
  points_W.reserve(points.points_B.size());
  for (const Eigen::Vector3f& p : points.points_B) {
    const Eigen::Vector3d p_B = p.cast<double>();
    const bool seen = p_B.allFinite() && (p_B - points.p_BR).norm() <= points.range_max_m;
    if (seen) points_W.emplace_back(X_WB * p_B);
  }
  evidence_.insert(X_WB * points.p_BR, points_W);
  ++counts_.scans;
  counts_.points_used += std::ssize(points_W);
  counts_.points_refused += std::ssize(points.points_B) - std::ssize(points_W);
}

std::vector<TerrainTile> TerrainMapper::take_tiles(Utime utime, BatchKey& next_key) {
  const bool clock_set_back = tiles_utime_ && utime < *tiles_utime_;
  const bool due = !tiles_utime_ || clock_set_back || utime - *tiles_utime_ >= microseconds(config_.period_s);
  if (!due || evidence_.changes() == 0) return {};
  tiles_utime_ = utime;
  const std::vector<VoxelChange> changes =
      evidence_.take_changes(static_cast<std::size_t>(config_.tiles_max) * kMaxVoxelsPerTile);
  std::vector<TerrainTile> tiles = in_tiles(changes, evidence_.voxel_m());
  for (TerrainTile& tile : tiles) {
    tile.key = next_key;
    tile.utime = utime;
    ++next_key.number;
  }
  counts_.tiles += std::ssize(tiles);
  counts_.voxels += std::ssize(changes);
  return tiles;
}

std::vector<Counter> TerrainMapper::counters() const {
  return {{"scans", counts_.scans},
          {"scans_waiting", std::ssize(waiting_)},
          {"scans_without_pose", counts_.scans_without_pose},
          {"points", counts_.points_used},
          {"points_refused", counts_.points_refused},
          {"terrain_tiles", counts_.tiles},
          {"terrain_voxels", counts_.voxels},
          {"terrain_voxels_waiting", static_cast<std::int64_t>(evidence_.changes())}};
}

}  // namespace comptonaut
