// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/saturation.h"

#include <gtest/gtest.h>

#include "nodes/reader_fixture.h"

namespace comptonaut {
namespace {

TEST(Saturation, BeginsNearTheLimitAndEndsWellBelowIt) {
  Saturation saturation(1e6);
  const auto at = [&](double share) {
    saturation.add(std::llround(share * 50e3), 50'000, 50'000);
    return saturation.keep_out();
  };
  EXPECT_FALSE(at(0.79));
  EXPECT_TRUE(at(0.80));
  for (const double share : {0.79, 0.81, 0.61, 0.9}) EXPECT_TRUE(at(share)) << share;
  EXPECT_EQ(saturation.times(), 1) << "said once";
  EXPECT_FALSE(at(0.59));
  EXPECT_FALSE(at(0.79));
  EXPECT_TRUE(at(2.0));
  EXPECT_EQ(saturation.times(), 2);
}

TEST(Saturation, CountsHitsPerTimeInWhichTheDetectorSaw) {
  Saturation saturation(1e6);
  saturation.add(20'000, 25'000, 50'000);
  EXPECT_TRUE(saturation.keep_out()) << "half of the data were lost";
  EXPECT_DOUBLE_EQ(saturation.hits_s(), 0.8e6);
  saturation.add(0, 0, 50'000);
  EXPECT_TRUE(saturation.keep_out()) << "a blind detector says nothing";
}

TEST(Saturation, IsInTheCountersOfAReader) {
  DetectorReaderConfig config;
  config.saturation_hits_s = 1000.0;
  auto reader = new_reader(config);
  std::string text = kStamp;
  for (int i = 0; i < 100; ++i) text += single(i, 0.031 + 0.0001 * i);  // 100 hits in a batch of 50 ms: 2000/s
  (void)reader.on_bytes(text + alive(0.0999));
  EXPECT_TRUE(reader.saturation().keep_out());
  EXPECT_DOUBLE_EQ(reader.saturation().hits_s(), 2000.0);
  (void)reader.on_bytes(alive(0.2));
  const auto counters = reader.counters();
  const auto value = [&](const std::string& name) {
    return std::find_if(counters.begin(), counters.end(), [&](const Counter& c) { return c.name == name; })->value;
  };
  EXPECT_EQ(value("keep_out"), 0);
  EXPECT_EQ(value("keep_outs"), 1);
}

}  // namespace
}  // namespace comptonaut
