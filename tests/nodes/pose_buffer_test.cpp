// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/pose_buffer.h"

#include <gtest/gtest.h>

namespace comptonaut {
namespace {

TEST(PoseBuffer, KeepsOrderAndForgetsOnlyTheOldest) {
  PoseBuffer poses(100);
  EXPECT_TRUE(poses.add({.utime = 200}));
  EXPECT_TRUE(poses.add({.utime = 100}));
  EXPECT_FALSE(poses.add({.utime = 200}));
  EXPECT_TRUE(poses.at(150));
  EXPECT_FALSE(poses.at(99));
  EXPECT_FALSE(poses.at(201));
  EXPECT_EQ(poses.last_known(10'000)->utime, 200);
  EXPECT_EQ(poses.last_known(150)->utime, 100);
  EXPECT_EQ(poses.last_known(50)->utime, 100);
  for (Utime utime = 300; utime < 300 + 5'000; ++utime) poses.add({.utime = utime});
  EXPECT_FALSE(poses.at(200));
  EXPECT_TRUE(poses.at(5'000));
}

// Else it would go on interpolating towards where the MAV was before, and forget each new pose as the oldest one.
TEST(PoseBuffer, StartsAnewWhenTheClockIsSetBack) {
  PoseBuffer poses(100);
  for (Utime utime = 100'000; utime < 105'000; ++utime) poses.add({.utime = utime});
  for (Utime utime = 50'000; utime <= 55'000; utime += 10) {
    EXPECT_TRUE(poses.add({.utime = utime, .p_WB = {1, 2, 3}}));
    ASSERT_TRUE(poses.at(utime)) << utime;
  }
  EXPECT_EQ(poses.last_known(1'000'000)->utime, 55'000);
  EXPECT_FALSE(poses.at(104'500)) << "of the clock before";
  EXPECT_EQ(poses.at(52'005)->p_WB, Eigen::Vector3d(1, 2, 3));
}

}  // namespace
}  // namespace comptonaut
