// SPDX-License-Identifier: BSD-3-Clause
#include "sim/pace.h"

#include <gtest/gtest.h>

#include "start_time.h"

namespace comptonaut {
namespace {

const PaceConfig kConfig{.lead_s = 0.5, .startup_s = 3.0};

TEST(Pace, GoesOnlyToTheStartUpAllowanceBeforeTheFirstTick) {
  Pace pace(kConfig, kStart_us, 10.0);
  EXPECT_EQ(pace.limit(1e9), kStart_us + 3 * kSecond_us);
  pace.on_tick(kStart_us - 50 * kSecond_us);  // of an earlier mission
  EXPECT_EQ(pace.limit(1e9), kStart_us + 3 * kSecond_us);
}

TEST(Pace, GoesOneSecondAndTheLeadBeyondTheLastTick) {
  Pace pace(kConfig, kStart_us, 10.0);
  pace.on_tick(kStart_us + 4 * kSecond_us);
  pace.on_tick(kStart_us + 2 * kSecond_us);
  EXPECT_EQ(pace.limit(0.0), kStart_us + 5'500'000);
}

TEST(Pace, NeverExceedsItsTimeScale) {
  Pace pace({.time_scale_max = 2.0}, kStart_us, 10.0);
  pace.on_tick(kStart_us + 8 * kSecond_us);
  EXPECT_EQ(pace.limit(0.5), kStart_us + kSecond_us);
  EXPECT_EQ(pace.limit(60.0), kStart_us + 9'500'000);
}

TEST(Pace, DoesNotHurryAfterItHadToWait) {
  Pace pace({.startup_s = 1.0, .time_scale_max = 2.0}, kStart_us, 100.0);
  EXPECT_EQ(pace.limit(20.0), kStart_us + kSecond_us);
  pace.on_tick(kStart_us + 50 * kSecond_us);
  EXPECT_EQ(pace.limit(20.5), kStart_us + 2 * kSecond_us);
}

TEST(Pace, IsOverWithTheTickOfTheHorizon) {
  Pace pace(kConfig, kStart_us, 10.0);
  pace.on_tick(kStart_us + 9 * kSecond_us);
  EXPECT_FALSE(pace.over());
  pace.on_tick(kStart_us + 10 * kSecond_us);
  EXPECT_TRUE(pace.over());
}

}  // namespace
}  // namespace comptonaut
