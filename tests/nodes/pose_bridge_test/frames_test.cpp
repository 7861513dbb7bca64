// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/frames.h"

#include <gtest/gtest.h>

#include "core/pose.h"
#include "core/random.h"

namespace comptonaut {
namespace {

Eigen::Matrix3d R_WN() { return (Eigen::Matrix3d() << 0, 1, 0, 1, 0, 0, 0, 0, -1).finished(); }  // east is N's y
Eigen::Matrix3d R_BF() { return Eigen::Vector3d(1, -1, -1).asDiagonal(); }

TEST(Frames, SwapsAreTheRotationsBetweenTheFrames) {
  EXPECT_NEAR(R_WN().determinant(), 1.0, 1e-15);
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d v = 10 * random.unit_vector();
    EXPECT_TRUE(swap_W_N(v).isApprox(R_WN() * v)) << i;
    EXPECT_TRUE(swap_B_F(v).isApprox(R_BF() * v)) << i;
    EXPECT_TRUE(swap_W_N(swap_W_N(v)).isApprox(v)) << i;
    EXPECT_TRUE(swap_B_F(swap_B_F(v)).isApprox(v)) << i;
  }
}

TEST(Frames, AttitudeIsTheProductOfRotationMatrices) {
  Random random(2);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Quaterniond q_NF(Eigen::AngleAxisd(random.uniform(-3, 3), random.unit_vector()));
    const Eigen::Matrix3d expected = R_WN() * q_NF.toRotationMatrix() * R_BF().transpose();
    EXPECT_TRUE(q_WB_from_NF(q_NF).toRotationMatrix().isApprox(expected)) << i;
  }
}

TEST(Frames, HeadingTurnsClockwiseFromNorth) {
  const double pi = std::numbers::pi;
  EXPECT_NEAR(heading_from_yaw(0.0), pi / 2, 1e-12);  // east
  EXPECT_NEAR(heading_from_yaw(pi / 2), 0.0, 1e-12);  // north
  EXPECT_NEAR(heading_from_yaw(-pi / 2), pi, 1e-12);  // south
  for (double yaw = -6; yaw < 6; yaw += 0.1) {
    const Eigen::Quaterniond q_NF(Eigen::AngleAxisd(heading_from_yaw(yaw), Eigen::Vector3d::UnitZ()));
    EXPECT_NEAR(std::remainder(yaw_of(q_WB_from_NF(q_NF)) - yaw, 2 * pi), 0.0, 1e-9) << yaw;
  }
}

}  // namespace
}  // namespace comptonaut
