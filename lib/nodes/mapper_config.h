// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <optional>

#include "nodes/terrain_config.h"
#include "nodes/terrain_mapper.h"

namespace comptonaut {

class Config;

struct MapperConfig {
  std::int64_t mission = 1;
  Eigen::Isometry3d X_BD = default_X_BD();  ///< the detector on the MAV
  double pose_wait_s = 1.0;                 ///< of data time that a batch waits for the poses of its moment
  double pose_gap_max_s = 0.2;              ///< poses further apart than this are not interpolated between
  std::filesystem::path journal_dir;        ///< where the daemon keeps every batch that it sends
  double fsync_period_s = 1.0;              ///< what a power cut costs at most
  TerrainConfig terrain;                    ///< the team's map, which range points are held against
  TerrainMapperConfig points;

  /// Below the MAV, the cathode's normal z_D down.
  static Eigen::Isometry3d default_X_BD();
};

/// Rotation from D to B for roll about x, then pitch about y, then yaw about z, all of B: R = Rz Ry Rx.
[[nodiscard]] Eigen::Quaterniond from_roll_pitch_yaw(double roll_rad, double pitch_rad, double yaw_rad);

[[nodiscard]] MapperConfig read_mapper_config(Config& config);

}  // namespace comptonaut
