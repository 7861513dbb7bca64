// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/mapper_config.h"

#include <numbers>

#include "config/config.h"

namespace comptonaut {
namespace {

constexpr double kPi = std::numbers::pi;

Eigen::Isometry3d pose(const Eigen::Vector3d& p_BD, double roll_rad, double pitch_rad, double yaw_rad) {
  return Eigen::Translation3d(p_BD) * from_roll_pitch_yaw(roll_rad, pitch_rad, yaw_rad);
}

Eigen::Isometry3d read_extrinsics(Config& config) {
  Eigen::Vector3d p_BD_m = MapperConfig::default_X_BD().translation();
  double roll_rad = kPi, pitch_rad = 0.0, yaw_rad = 0.0;
  config.read("p_BD_m", p_BD_m, {.min = -10.0, .max = 10.0});
  config.read("roll_rad", roll_rad, {.min = -kPi, .max = kPi});
  config.read("pitch_rad", pitch_rad, {.min = -kPi / 2, .max = kPi / 2});
  config.read("yaw_rad", yaw_rad, {.min = -kPi, .max = kPi});
  return pose(p_BD_m, roll_rad, pitch_rad, yaw_rad);
}

void read_points(Config& config, TerrainMapperConfig& points) {
  config.read("range_max_m", points.evidence.range_max_m, {.min = 0.1, .max = 1000.0});
  config.read("position_sigma_m", points.evidence.position_sigma_m, {.min = 0.0, .max = 10.0});
  config.read("attitude_sigma_rad", points.evidence.attitude_sigma_rad, {.min = 0.0, .max = 1.0});
  config.read("period_s", points.period_s, {.min = 0.05, .max = 3600.0});
  config.read("tiles_max", points.tiles_max, {.min = 1, .max = 1000});
}

}  // namespace

Eigen::Isometry3d MapperConfig::default_X_BD() { return pose({0.0, 0.0, -0.05}, kPi, 0.0, 0.0); }

Eigen::Quaterniond from_roll_pitch_yaw(double roll_rad, double pitch_rad, double yaw_rad) {
  return Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitX());
}

MapperConfig read_mapper_config(Config& config) {
  MapperConfig mapper;
  config.require("mission", mapper.mission, Range{.min = 0});
  config.section("extrinsics", [&](Config& section) { mapper.X_BD = read_extrinsics(section); });
  config.read("pose_wait_s", mapper.pose_wait_s, {.min = 0.0, .max = 60.0});
  config.read("pose_gap_max_s", mapper.pose_gap_max_s, {.min = 0.001, .max = 10.0});
  config.require("journal_dir", mapper.journal_dir);
  config.read("fsync_period_s", mapper.fsync_period_s, {.min = 0.01, .max = 60.0});
  mapper.terrain = read_terrain_config(config);
  config.section("points", [&](Config& section) { read_points(section, mapper.points); });
  return mapper;
}

}  // namespace comptonaut
