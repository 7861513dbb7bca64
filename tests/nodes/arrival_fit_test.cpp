// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/arrival_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/random.h"
#include "nodes/reader_fixture.h"

namespace comptonaut {
namespace {

constexpr Utime kChipStart = 1'700'000'000'123'456;

/// A chip whose clock runs at its own pace, and rows that take their time.
struct Source {
  double drift = 0.0;
  double swing = 0.0;  ///< the drift goes up and down by this, once in 200 s
  double least_us = 300.0;
  std::function<double(Random&)> delay_us = [](Random& random) { return 5000.0 * random.exponential(); };

  /// UTC after chip time 0.
  [[nodiscard]] double utc_us(double chip_us) const {
    const double omega = 2.0 * M_PI / 200e6;
    return chip_us * (1.0 + drift) + swing / omega * (1.0 - std::cos(omega * chip_us));
  }
};

struct Errors {
  double worst_us = 0.0;      ///< after the first ten seconds
  double worst_sigmas = 0.0;  ///< at any time
  double last_sigma_us = 0.0;
};

/// Reads `rate_hz` times a second, from chip time `join_s` on for so long.
Errors follow(const Source& source, std::uint64_t seed, double rate_hz, double join_s, double duration_s) {
  Random random(seed);
  ArrivalFit fit;
  Errors errors;
  for (double t_s = join_s; t_s < join_s + duration_s; t_s += random.exponential() / rate_hz) {
    const auto chip = static_cast<ChipTime>(std::llround(1e6 * t_s)) * kChipTimePerUs;
    const double chip_us = static_cast<double>(chip / kChipTimePerUs);
    const double utc_us = source.utc_us(chip_us);
    fit.add(chip, kChipStart + std::llround(utc_us + source.least_us + source.delay_us(random)));
    const auto now = fit.fit();
    const double error_us = static_cast<double>(now->start_utime - kChipStart) + chip_us - utc_us;
    if (t_s > join_s + 10.0) errors.worst_us = std::max(errors.worst_us, std::abs(error_us));
    errors.worst_sigmas = std::max(errors.worst_sigmas, std::abs(error_us) / now->sigma_us);
    errors.last_sigma_us = now->sigma_us;
  }
  return errors;
}

TEST(ArrivalFit, FindsUtcToAMillisecondThroughJitterOfFive) {
  double worst_us = 0.0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Errors errors = follow({}, seed, 200.0, 0.0, 120.0);
    EXPECT_LT(errors.worst_us, 1000.0) << seed;
    worst_us = std::max(worst_us, errors.worst_us);
    EXPECT_LT(errors.last_sigma_us, 2000.0) << seed;
    EXPECT_LT(errors.worst_sigmas, 4.0) << seed;
  }
  RecordProperty("worst_us", std::to_string(worst_us));
}

TEST(ArrivalFit, FollowsDriftThatChanges) {
  double worst_us = 0.0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Errors errors = follow({.drift = 40e-6, .swing = 20e-6}, seed, 100.0, 0.0, 600.0);
    EXPECT_LT(errors.worst_us, 2000.0) << seed << ": 40 ppm alone are 24 ms in this time";
    worst_us = std::max(worst_us, errors.worst_us);
  }
  RecordProperty("worst_us", std::to_string(worst_us));
}

TEST(ArrivalFit, ALateJoinAndSlowBurstsAreAsGood) {
  // A program that reads the detector every 50 ms hands on rows in bursts; now and then it sleeps.
  const Source bursts{.drift = -50e-6, .delay_us = [](Random& random) {
                        return random.uniform() < 0.05 ? 400e3 * random.uniform() : 8e3 * random.uniform();
                      }};
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Errors errors = follow(bursts, seed, 20.0, 36'000.0, 300.0);
    EXPECT_LT(errors.worst_us, 3000.0) << seed;
    EXPECT_LT(errors.worst_sigmas, 10.0) << seed;
  }
}

TEST(ArrivalFit, AMeanInsteadOfTheLowerEdgeWouldBeWrongByTheJitter) {
  // What the test's bounds are worth: the mean arrival is 5 ms late, far beyond them.
  Random random(1);
  const Source source;
  double sum_us = 0.0;
  for (int i = 0; i < 1000; ++i) sum_us += source.least_us + source.delay_us(random);
  EXPECT_GT(sum_us / 1000.0, 4500.0);
}

TEST(ArrivalFit, AClockThatIsSetIsFollowedWithinSeconds) {
  for (const double step_us : {-30e6, 30e6}) {
    ArrivalFit fit;
    Random random(1);
    const auto run = [&](int from_s, int to_s, double added_us) {
      for (int i = 100 * from_s; i < 100 * to_s; ++i) {
        const Utime t_us = 10'000 * i;
        fit.add(t_us * kChipTimePerUs, kChipStart + t_us + std::llround(added_us + 2000.0 * random.exponential()));
      }
    };
    run(1, 30, 0.0);
    EXPECT_NEAR(static_cast<double>(fit.fit()->start_utime - kChipStart), 0.0, 1000.0);
    run(30, 35, step_us);
    EXPECT_NEAR(static_cast<double>(fit.fit()->start_utime - kChipStart), step_us, 1000.0) << step_us;
  }
}

struct Arrived {
  Batches batches;
  double newest_s = 0.0;  ///< chip time of the last row
};

/// Reads rows through a reader as they arrive.
Arrived read_arrivals(const Source& source, std::uint64_t seed, double join_s, double duration_s, double hits_s) {
  Random random(seed);
  auto reader = new_reader();
  Arrived arrived;
  std::int64_t index = 1000;
  for (double t_s = join_s; t_s < join_s + duration_s; t_s += random.exponential() / hits_s) {
    const Utime arrival =
        kChipStart + std::llround(source.utc_us(1e6 * t_s) + source.least_us + source.delay_us(random));
    arrived.batches.add(reader.on_bytes(single(index++, t_s), arrival));
    arrived.newest_s = t_s;
  }
  arrived.batches.add(reader.on_end());
  return arrived;
}

TEST(ArrivalFit, AReaderGivesEachBatchItsTrueTimeWithinItsSigmaAndNoneTwice) {
  const Source source{.drift = 80e-6};
  const double join_s = 7200.0, hits_s = 100.0;
  const auto [batches, newest_s] = read_arrivals(source, 3, join_s, 60.0, hits_s);
  ASSERT_GT(batches.all.size(), 1100u);
  for (std::size_t i = 1; i < batches.all.size(); ++i) {
    EXPECT_EQ(batches.all[i].utime, batches.all[i - 1].utime + kBatch_us) << i;
  }
  EXPECT_NEAR(batches.singles(), 6000, 300);
  const double seen_share = 1.0 - 2.0 * hits_s * 1e-9 * max_drift_ns(SensorConfig{});
  const double span_us = 1e6 * (newest_s - join_s) * seen_share;
  const auto live_us = static_cast<double>(batches.live_us());
  EXPECT_LT(live_us, span_us + 100.0);
  EXPECT_GT(live_us, span_us - 50e3) << "what the first row took is lost while the fit comes down to it";
  double settled_us = 0.0;  // per batch, from 10 s on
  for (int i = 200; i < 1100; ++i) settled_us += batches.all[static_cast<std::size_t>(i)].live_us / 900.0;
  EXPECT_NEAR(settled_us, 50e3 * (1.0 - source.drift) * seen_share, 1.0) << "each moment of the chip's clock once";
  EXPECT_LT(batches.all.back().utime_sigma_us, 2500);
  const double end_us = source.utc_us(1e6 * (join_s + 60.0)) + static_cast<double>(kChipStart);
  EXPECT_NEAR(static_cast<double>(batches.all.back().utime), end_us - 25e3, 30e3);
}

TEST(ArrivalFit, RecordedArrivalsReplayToTheSameBatches) {
  const Batches first = read_arrivals({.drift = 10e-6}, 4, 10.0, 20.0, 50.0).batches;
  const Batches again = read_arrivals({.drift = 10e-6}, 4, 10.0, 20.0, 50.0).batches;
  ASSERT_EQ(first.all.size(), again.all.size());
  for (std::size_t i = 0; i < first.all.size(); ++i) {
    EXPECT_EQ(first.all[i].utime, again.all[i].utime) << i;
    EXPECT_EQ(first.all[i].utime_sigma_us, again.all[i].utime_sigma_us) << i;
    EXPECT_EQ(first.all[i].channels, again.all[i].channels) << i;
  }
}

}  // namespace
}  // namespace comptonaut
