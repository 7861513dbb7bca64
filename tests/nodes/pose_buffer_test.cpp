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

}  // namespace
}  // namespace comptonaut
