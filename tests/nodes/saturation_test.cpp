// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/saturation.h"

#include <gtest/gtest.h>

#include "detector/rate_loss.h"
#include "nodes/reader_fixture.h"

namespace comptonaut {
namespace {

TEST(Saturation, BeginsNearTheLimitAndEndsWellBelowIt) {
  Saturation saturation;
  const auto at = [&](double share) {
    saturation.add(share * kNearSaturation);
    return saturation.keep_out();
  };
  EXPECT_FALSE(at(0.99));
  EXPECT_TRUE(at(1.0));
  for (const double share : {0.99, 1.01, 0.76, 1.2}) EXPECT_TRUE(at(share)) << share;
  EXPECT_EQ(saturation.times(), 1) << "said once";
  EXPECT_FALSE(at(0.74));
  EXPECT_FALSE(at(0.99));
  EXPECT_TRUE(at(2.0));
  EXPECT_EQ(saturation.times(), 2);
}

/// Hits of one pixel each, one every `every_ns`, from one time to another.
std::string rows(std::int64_t& index, double from_s, double to_s, double every_ns) {
  std::string text;
  for (double t_ns = 1e9 * from_s; t_ns < 1e9 * to_s; t_ns += every_ns, ++index) {
    text += t3pa_row(index, make_hit_anywhere(index, 300.0, t_ns));
  }
  return text;
}

TEST(Saturation, IsInTheCountersOfAReaderAndLiveTimeFallsWithPileUp) {
  auto reader = new_reader();
  std::int64_t index = 0;
  Batches batches;
  batches.add(reader.on_bytes(kStamp + rows(index, 0.03, 0.08, 500.0) + alive(0.09)));  // two million a second
  ASSERT_EQ(batches.all.size(), 2u);
  EXPECT_TRUE(reader.saturation().keep_out());
  EXPECT_NEAR(reader.saturation().share() * kHitsMax_per_s, 2e6, 2e4);
  EXPECT_LT(batches.all[1].live_us, 40'000) << "of photons at such a rate every fourth has another in its window";
  (void)reader.on_bytes(alive(0.2));
  EXPECT_FALSE(reader.saturation().keep_out());
  const auto counters = reader.counters();
  const auto value = [&](const std::string& name) {
    return std::find_if(counters.begin(), counters.end(), [&](const Counter& c) { return c.name == name; })->value;
  };
  EXPECT_EQ(value("keep_out"), 0);
  EXPECT_EQ(value("keep_outs"), 1);
}

}  // namespace
}  // namespace comptonaut
