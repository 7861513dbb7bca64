// SPDX-License-Identifier: BSD-3-Clause
// How long a detector lived, by what its stream held.
#include <gtest/gtest.h>

#include <cmath>

#include "detector/read_stream.h"

namespace comptonaut {
namespace {

TEST(HitStreamLife, LostDataAreDeadTime) {
  const std::string text = "0 5 40000 9 0 0\n1 116 0 0 0 1\n2 117 200000 0 0 1\n3 5 400000 9 0 0\n";
  const Read result = read(text);
  EXPECT_EQ(result.counts.lost_gaps, 1);
  EXPECT_NEAR(result.live_s, 200000 * 25e-9, 1e-9);
}

TEST(HitStreamLife, AGapThatNothingClosesEndsWithTheNextHit) {
  const std::string text = "0 5 40000 9 0 0\n1 116 200000 0 0 1\n2 5 300000 9 0 0\n3 5 400000 9 0 0\n";
  const Read result = read(text);
  EXPECT_EQ(result.counts.lost_gaps, 1);
  EXPECT_NEAR(result.live_s, 300000 * 25e-9, 1e-9);
}

TEST(HitStreamLife, SilenceWithoutLifeIsDeadTimeOfALiveStreamOnly) {
  std::string text;
  for (const std::int64_t toa_ms : {0, 400, 2400, 2500}) text += "# alive " + std::to_string(40000 * toa_ms) + "\n";
  EXPECT_NEAR(read(text, false).live_s, 0.5, 1e-9);
  EXPECT_NEAR(read(text, true).live_s, 2.5, 1e-9);
}

TEST(HitStreamLife, ARecordingsSilenceIsBelievedForAWhile) {
  const auto row = [](int index, double t_s) {
    return std::to_string(index) + " 5 " + std::to_string(std::llround(40e6 * t_s)) + " 9 0 0\n";
  };
  EXPECT_NEAR(read(row(0, 1.0) + row(1, 5.9)).live_s, 5.9, 1e-6);
  EXPECT_NEAR(read(row(0, 1.0) + row(1, 9.0) + row(2, 9.5)).live_s, 1.0 + 5.0 + 0.5, 1e-6);
  std::string late = row(0, 1.0);
  for (int i = 1; i <= 4; ++i) late += row(i, 30.0 * 86400.0 + i);  // believed as they agree
  EXPECT_NEAR(read(late).live_s, 1.0 + 5.0 + 3.0, 1e-6);
  const auto alive = [](double t_s) { return "# alive " + std::to_string(std::llround(40e6 * t_s)) + "\n"; };
  EXPECT_NEAR(read(alive(1.0) + alive(9.0)).live_s, 9.0, 1e-6);
  std::string far = alive(1.0);
  for (int i = 1; i <= 4; ++i) far += alive(30.0 * 86400.0 + i);
  EXPECT_NEAR(read(far).live_s, 1.0 + 10.0 + 3.0, 1e-6);
}
}  // namespace
}  // namespace comptonaut
