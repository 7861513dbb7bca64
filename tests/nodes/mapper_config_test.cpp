// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/mapper_config.h"

#include <gtest/gtest.h>

#include "config/config.h"

namespace comptonaut {
namespace {

TEST(MapperConfig, ShipsWithTheDefaultsOfTheCode) {
  const auto shipped = load_config(COMPTONAUT_SOURCE_DIR "/config/mapper.yaml", read_mapper_config);
  const MapperConfig coded;
  EXPECT_TRUE(shipped.X_BD.isApprox(coded.X_BD, 1e-12));
  EXPECT_EQ(shipped.mission, coded.mission);
  EXPECT_EQ(shipped.pose_wait_s, coded.pose_wait_s);
  EXPECT_EQ(shipped.pose_gap_max_s, coded.pose_gap_max_s);
  EXPECT_EQ(shipped.fsync_period_s, coded.fsync_period_s);
}

TEST(MapperConfig, TurnsRollThenPitchThenYaw) {
  const Eigen::Quaterniond q = from_roll_pitch_yaw(0.1, 0.2, 0.3);
  const Eigen::Vector3d forward = q * Eigen::Vector3d::UnitX();
  EXPECT_NEAR(std::atan2(forward.y(), forward.x()), 0.3, 1e-12);
  EXPECT_NEAR(std::asin(-forward.z()), 0.2, 1e-12);
  const Eigen::Vector3d up_B = q.inverse() * Eigen::Vector3d::UnitZ();
  EXPECT_NEAR(std::atan2(up_B.y(), up_B.z()), 0.1, 1e-12);
}

TEST(MapperConfig, NeedsMissionAndJournal) {
  EXPECT_THROW((void)parse_config("journal_dir: j", "m.yaml", read_mapper_config), ConfigError);
  EXPECT_THROW((void)parse_config("mission: 1", "m.yaml", read_mapper_config), ConfigError);
  EXPECT_THROW((void)parse_config("{mission: 1, journal_dir: j, pose_wait_s: -1}", "m.yaml", read_mapper_config),
               ConfigError);
}

}  // namespace
}  // namespace comptonaut
