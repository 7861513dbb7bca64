// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/batch_check.h"

#include <algorithm>
#include <cmath>

namespace comptonaut {
namespace {

constexpr double kFarAway_m = 1000.0;
constexpr double kFast_m_s = 100.0;
constexpr double kUnitTolerance = 1e-5;  // of a norm after rounding to float
constexpr double kConeDistance_m = 5.0;  // flown within a batch
constexpr std::int32_t kDurationMax_us = 1'000'000;
constexpr Utime kYear2100 = 4'102'444'800'000'000;
constexpr std::int64_t kNumberMax = 1'000'000'000'000;

bool is_unit(double norm) { return std::abs(norm - 1.0) <= kUnitTolerance; }  // false for NaN

bool is_sane(const Cone& cone, const MeasurementBatch& batch) {
  return cone.channel >= 0 && cone.channel < std::ssize(batch.channels) && is_unit(cone.axis_W.norm()) &&
         std::abs(cone.cos_beta) <= 1.0 && cone.weight >= 0.0 && cone.weight <= 1.0 &&
         (cone.p_WS - batch.p_WD).norm() <= kConeDistance_m;
}

bool is_near(const Eigen::Vector3d& p_W, const Area& area) {
  const Area wide{.x_min_m = area.x_min_m - kFarAway_m,
                  .x_max_m = area.x_max_m + kFarAway_m,
                  .y_min_m = area.y_min_m - kFarAway_m,
                  .y_max_m = area.y_max_m + kFarAway_m};
  return wide.contains(p_W.x(), p_W.y()) && std::abs(p_W.z()) <= 10.0 * kFarAway_m;
}

bool has_sane_place(const MeasurementBatch& batch, const Area& area) {
  return is_near(batch.p_WD, area) && is_unit(batch.q_WD.norm()) && batch.v_WD.norm() <= kFast_m_s;
}

bool is_sane_number(std::int64_t number) { return number >= 0 && number <= kNumberMax; }

bool has_sane_time(const MeasurementBatch& batch) {
  return batch.utime > 0 && batch.utime < kYear2100 && batch.duration_us > 0 && batch.duration_us <= kDurationMax_us &&
         batch.live_us >= 0 && batch.live_us <= batch.duration_us;
}

}  // namespace

bool is_sane(const MeasurementBatch& batch, const Area& area) {
  const bool measured = batch.live_us > 0 || !batch.cones.empty();  // without a pose, nothing was measured
  const bool placed = batch.has_pose() || measured;
  return is_sane_number(batch.key.number) && has_sane_time(batch) && (!placed || has_sane_place(batch, area)) &&
         std::all_of(batch.cones.begin(), batch.cones.end(), [&](const Cone& cone) { return is_sane(cone, batch); });
}

bool is_sane(const TerrainTile& tile) {
  return is_sane_number(tile.key.number) && tile.utime > 0 && tile.utime < kYear2100;
}

bool fits_map(const TerrainTile& tile, const World& world, const Area& area) {
  constexpr double kSameEdge = 1e-6;
  return std::abs(tile.voxel_m - world.voxel_m()) <= kSameEdge * world.voxel_m() &&
         std::all_of(tile.voxels.begin(), tile.voxels.end(),
                     [&](const VoxelChange& change) { return is_near(centre_of(change.voxel, tile.voxel_m), area); });
}

}  // namespace comptonaut
