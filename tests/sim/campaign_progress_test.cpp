// SPDX-License-Identifier: BSD-3-Clause
#include "sim/campaign_progress.h"

#include <gtest/gtest.h>

#include "core/random.h"

namespace comptonaut {
namespace {

TEST(ProgressLines, TellMissionsAndTimes) {
  ProgressLines lines;
  EXPECT_EQ(lines.at({.share = 0.0, .missions_done = 0, .missions = 20}, 1.0), std::nullopt);
  EXPECT_EQ(lines.at({.share = 0.25, .missions_done = 4, .missions = 20}, 1234.0),
            "4 of 20 missions done, 25 % of the work; 0:20:34 elapsed, about 1:01:42 remaining\n");
  EXPECT_EQ(lines.at({.share = 0.29, .missions_done = 5, .missions = 20}, 1400.0), std::nullopt);
  EXPECT_EQ(lines.at({.share = 1.0, .missions_done = 20, .missions = 20}, 360000.0),
            "20 of 20 missions done, 100 % of the work; 100:00:00 elapsed, about 0:00:00 remaining\n");
  EXPECT_EQ(lines.at({.share = 1.0, .missions_done = 20, .missions = 20}, 360000.2), std::nullopt);
}

TEST(ProgressLines, EndWithTheMissionsAlsoWhereSomeFailed) {
  ProgressLines lines;
  EXPECT_EQ(lines.at({.share = 1.0, .missions_done = 1, .missions = 2}, 10.0).value().substr(0, 6), "1 of 2");
  EXPECT_EQ(lines.at({.share = 0.6, .missions_done = 2, .missions = 2}, 12.0),
            "2 of 2 missions done, 60 % of the work; 0:00:12 elapsed, about 0:00:00 remaining\n");
}

TEST(ProgressLines, AreTenAtMostAndTheEndIsAlwaysTold) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    const double step_max = random.uniform(1e-3, 0.5);
    ProgressLines lines;
    int told = 0;
    for (double share = 0.0; share < 1.0; share += random.uniform(0.0, step_max)) {
      told += lines.at({.share = share, .missions_done = 1, .missions = 2}, 100.0 * share).has_value();
    }
    EXPECT_TRUE(lines.at({.share = 1.0, .missions_done = 2, .missions = 2}, 100.0).has_value()) << seed;
    EXPECT_LE(told, 9) << seed;
    EXPECT_TRUE(told == 9 || step_max > 0.1) << seed;
  }
}

}  // namespace
}  // namespace comptonaut
