// SPDX-License-Identifier: BSD-3-Clause
#include "core/pose.h"

#include <gtest/gtest.h>

#include <numbers>

namespace comptonaut {
namespace {

TEST(Interpolate, GoesStraightAndTurnsEvenlyBetweenTwoPoses) {
  const StampedPose before{.utime = 1'000'000, .p_WB = {0, 0, 2}, .q_WB = from_yaw(0.2), .v_WB_B = {1, 0, 0}};
  const StampedPose after{.utime = 1'020'000, .p_WB = {0.16, 0.08, 2}, .q_WB = from_yaw(0.6), .v_WB_B = {2, 0, 0}};
  const auto at = interpolate(before, after, 1'005'000);
  ASSERT_TRUE(at);
  EXPECT_EQ(at->utime, 1'005'000);
  EXPECT_TRUE(at->p_WB.isApprox(Eigen::Vector3d(0.04, 0.02, 2), 1e-12)) << at->p_WB.transpose();
  EXPECT_NEAR(yaw_of(at->q_WB), 0.3, 1e-12);
  EXPECT_NEAR(at->v_WB_B.x(), 1.25, 1e-12);
}

TEST(Interpolate, NeverLooksOutsideItsTwoPoses) {
  const StampedPose before{.utime = 10}, after{.utime = 20};
  EXPECT_FALSE(interpolate(before, after, 9));
  EXPECT_FALSE(interpolate(before, after, 21));
  EXPECT_TRUE(interpolate(before, after, 10));
  EXPECT_TRUE(interpolate(before, after, 20));
  EXPECT_TRUE(interpolate(before, before, 10));
}

TEST(Yaw, ComesBackFromItsRotation) {
  for (double yaw_rad = -3.1; yaw_rad < std::numbers::pi; yaw_rad += 0.1) {
    EXPECT_NEAR(yaw_of(from_yaw(yaw_rad)), yaw_rad, 1e-12);
  }
}

TEST(FloorTo, RoundsDownOnBothSidesOfTheEpoch) {
  EXPECT_EQ(floor_to(123'456, kBatch_us), 100'000);
  EXPECT_EQ(floor_to(100'000, kBatch_us), 100'000);
  EXPECT_EQ(floor_to(-1, kBatch_us), -50'000);
}

}  // namespace
}  // namespace comptonaut
