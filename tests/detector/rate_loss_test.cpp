// SPDX-License-Identifier: BSD-3-Clause
#include "detector/rate_loss.h"

#include <gtest/gtest.h>

#include "core/random.h"
#include "detector/make_hits.h"

namespace comptonaut {
namespace {

constexpr ChipTime kSecond = 640'000'000;

TEST(RateLoss, NothingIsMissedWhereNothingComes) {
  for (const ChipTime live : {ChipTime{0}, ChipTime{-5}, kSecond}) {
    const RateLoss loss = rate_loss({}, live, 86.0);
    EXPECT_EQ(loss.seen_share(), 1.0);
    EXPECT_FALSE(loss.near_saturation);
  }
}

TEST(RateLoss, PixelsAreBlindForToTAndReadout) {
  // A pixel that fires 1000 times a second, 100 ticks each, is blind for 1000 x (2500 + 475) ns.
  const RateLoss loss = rate_loss({.events = 1000, .hits = 1000, .tot_ticks = 100'000}, kSecond, 86.0);
  EXPECT_NEAR(loss.pixel_dead_share, 2.975e-3 / 65536.0, 1e-12);
}

TEST(RateLoss, NearTheChipsLimitItSaysSo) {
  EXPECT_FALSE(rate_loss({.hits = 1'600'000}, kSecond, 86.0).near_saturation);
  const RateLoss loss = rate_loss({.hits = 1'700'000}, kSecond, 86.0);
  EXPECT_TRUE(loss.near_saturation);
  EXPECT_NEAR(loss.saturation, 1.7 / 2.35, 1e-12);
}

TEST(RateLoss, ImpossibleRatesArePiledUpAsAWhole) {
  EXPECT_EQ(rate_loss({.events = 1'000'000'000}, kSecond, 86.0).pile_up_share, 1.0);
}

// Truth by counting: photons at random times, one pixel each, far apart.
TEST(RateLoss, PileUpIsTheShareOfPhotonsThatAreNotAlone) {
  Random random(41);
  for (const double rate_per_s : {1e4, 1e5, 5e5, 1e6}) {
    std::vector<Hit> hits;
    double t_ns = 1e6;
    const double mean_gap_ns = 1e9 / rate_per_s;
    for (int i = 0; i < 100'000; ++i) {
      t_ns += mean_gap_ns * random.exponential();
      hits.push_back(make_hit(32 * (i % 8), 32 * (i / 8 % 8), 100.0, t_ns));
    }
    const EventRules rules;
    RateTotals totals;
    double alone = 0.0;
    for (const DetectorEvent& event : find_events(hits, rules, typical_calibration())) {
      totals.add(event);
      alone += event.clusters == 1 ? 1.0 : 0.0;
    }
    EXPECT_EQ(totals.hits, std::ssize(hits));
    const RateLoss loss = rate_loss(totals, hits.back().t - hits.front().t, max_drift_ns(rules.sensor));
    const double expected = 1.0 - alone / 100'000.0;
    EXPECT_NEAR(loss.pile_up_share, expected, 0.002 + 0.01 * expected) << rate_per_s << " photons/s";
  }
}

}  // namespace
}  // namespace comptonaut
