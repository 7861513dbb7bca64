// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>

#include "nodes/coordinator_fixture.h"

namespace comptonaut {
namespace {

void hear(Coordinator& coordinator, const std::vector<MeasurementBatch>& batches) {
  for (const MeasurementBatch& batch : batches) coordinator.on_measurements(batch);
}

TEST(CoordinatorLate, LeavesOutTheTicksThatWereOverMeanwhileButNoMeasurement) {
  const auto mission = some_mission(6);
  Coordinator late = make_coordinator(small_config());
  hear(late, mission);
  const auto tick = late.tick_latest_complete();
  ASSERT_TRUE(tick);
  EXPECT_EQ(tick->state.utime, kMissionStart + 6 * kSecond_us);
  EXPECT_EQ(tick->state.viewpoints, 360);
  EXPECT_EQ(tick->plans.size(), 3u);
  EXPECT_EQ(counter(late, "ticks"), 1);
  EXPECT_EQ(counter(late, "ticks_late"), 1);
  EXPECT_FALSE(late.tick_latest_complete());

  Coordinator follower = make_coordinator(small_config());
  hear(follower, mission);
  const auto followed = follower.follow(tick->state.utime, tick->state.basis);
  ASSERT_TRUE(followed) << "a basis says all, whatever was left out before it";
  EXPECT_EQ(followed->state.lambda_hash, tick->state.lambda_hash);
}

TEST(CoordinatorLate, WaitsForTheWholeTeam) {
  auto mission = some_mission(6);
  std::erase_if(mission, [](const MeasurementBatch& b) { return b.key.sender == 3 && b.key.number >= 86; });
  Coordinator late = make_coordinator(small_config());
  hear(late, mission);
  const auto tick = late.tick_latest_complete();
  ASSERT_TRUE(tick);
  EXPECT_EQ(tick->state.utime, kMissionStart + 4 * kSecond_us);
  EXPECT_FALSE(late.tick_latest_complete());
}

TEST(CoordinatorLate, OneThatKeepsUpLeavesNothingOut) {
  Coordinator other = make_coordinator(small_config()), quick = make_coordinator(small_config());
  int ticks = 0;
  for (const MeasurementBatch& batch : some_mission(5)) {
    other.on_measurements(batch);
    quick.on_measurements(batch);
    const auto expected = other.tick_if_complete();
    const auto tick = quick.tick_latest_complete();
    ASSERT_EQ(tick.has_value(), expected.has_value());
    if (!tick) continue;
    ++ticks;
    EXPECT_EQ(tick->state.utime, expected->state.utime);
    EXPECT_EQ(tick->state.lambda_hash, expected->state.lambda_hash);
  }
  EXPECT_EQ(ticks, 5);
  EXPECT_EQ(counter(quick, "ticks_late"), 0);
}

}  // namespace
}  // namespace comptonaut
