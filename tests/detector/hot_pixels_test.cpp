// SPDX-License-Identifier: BSD-3-Clause
#include "detector/hot_pixels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/random.h"
#include "detector/make_hits.h"

namespace comptonaut {
namespace {

constexpr ChipTime kSecond = 640'000'000;  // units of 25/16 ns

/// Hits of a stretch of time, in its order.
class Stream {
 public:
  explicit Stream(std::uint64_t seed) : random_(seed) {}

  void light(double from_s, double to_s, double hits_s) {
    const auto pixel = [&] { return static_cast<std::uint16_t>(random_() % (kChipPixels * kChipPixels)); };
    poisson(from_s, to_s, hits_s, pixel);
  }
  void light_spot(double from_s, double to_s, double hits_s, int x, int y, double sigma_px) {
    const auto at = [&](int middle) {
      return std::clamp(middle + static_cast<int>(sigma_px * random_.normal()), 0, kChipPixels - 1);
    };
    poisson(from_s, to_s, hits_s, [&] { return pixel_at(at(x), at(y)); });
  }
  void fire(double from_s, double to_s, double hits_s, int x, int y) {
    poisson(from_s, to_s, hits_s, [&] { return pixel_at(x, y); });
  }
  void add(double t_s, int x, int y) {
    hits.push_back({.t = static_cast<ChipTime>(t_s * kSecond), .pixel = pixel_at(x, y), .tot = 50});
  }
  const std::vector<Hit>& ordered() {
    std::stable_sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) { return a.t < b.t; });
    return hits;
  }
  std::vector<Hit> hits;

 private:
  void poisson(double from_s, double to_s, double hits_s, const std::function<std::uint16_t()>& pixel) {
    for (double t_s = from_s + random_.exponential() / hits_s; t_s < to_s; t_s += random_.exponential() / hits_s) {
      hits.push_back({.t = static_cast<ChipTime>(t_s * kSecond), .pixel = pixel(), .tot = 50});
    }
  }
  Random random_;
};

/// What became of a stream.
struct Outcome {
  std::vector<Hit> kept, left_out;
  std::vector<HotPixel> masked;  ///< at its end
  std::int64_t times = 0;

  [[nodiscard]] auto kept_of(int x, int y, double from_s = 0.0, double to_s = 1e9) const {
    return std::count_if(kept.begin(), kept.end(), [&](const Hit& hit) {
      const double t_s = static_cast<double>(hit.t) / kSecond;
      return hit.pixel == pixel_at(x, y) && t_s >= from_s && t_s < to_s;
    });
  }
  bool operator==(const Outcome&) const = default;
};

/// Hands the hits over in pieces of `step` hits.
Outcome watch(const std::vector<Hit>& hits, std::size_t step = 1000) {
  HotPixels hot_pixels{HotPixelConfig{}};
  Outcome outcome;
  for (std::size_t i = 0; i < hits.size(); i += step) {
    const auto part = std::span(hits).subspan(i, std::min(step, hits.size() - i));
    const auto [kept, left_out] = hot_pixels.split(part, part.back().t);
    EXPECT_EQ(kept.size() + left_out.size(), part.size());
    outcome.kept.insert(outcome.kept.end(), kept.begin(), kept.end());
    outcome.left_out.insert(outcome.left_out.end(), left_out.begin(), left_out.end());
  }
  outcome.masked.assign(hot_pixels.masked().begin(), hot_pixels.masked().end());
  outcome.times = hot_pixels.times();
  EXPECT_EQ(hot_pixels.hits(), std::ssize(outcome.left_out));
  return outcome;
}

TEST(HotPixels, OnesAreMaskedAfterTheirFirstHitsAndNoOtherHitIsLost) {
  for (const double light_hits_s : {10.0, 1'000.0, 100'000.0}) {
    Stream stream(1);
    stream.light(0.0, 20.0, light_hits_s);
    const std::vector<std::pair<int, int>> hot = {{0, 0}, {100, 70}, {101, 70}, {255, 30}, {17, 255}};
    for (const auto& [x, y] : hot) stream.fire(4.0, 20.0, 500.0, x, y);
    const Outcome outcome = watch(stream.ordered());
    EXPECT_EQ(outcome.masked.size(), hot.size()) << light_hits_s;
    EXPECT_EQ(outcome.times, std::ssize(hot)) << light_hits_s;
    for (const auto& [x, y] : hot) {
      EXPECT_LE(outcome.kept_of(x, y, 4.0), 27 + 10 * light_hits_s * 10.0 / 65536.0) << x << ", " << y;
    }
    EXPECT_TRUE(std::all_of(outcome.left_out.begin(), outcome.left_out.end(), [&](const Hit& hit) {
      return std::count(hot.begin(), hot.end(), std::pair(pixel_x(hit.pixel), pixel_y(hit.pixel))) == 1;
    })) << light_hits_s;
  }
}

TEST(HotPixels, ASourceThatLightsTheChipOrAPartOfItMakesNone) {
  Stream chip(2);
  chip.light(0.0, 2.0, 50.0);
  chip.light(2.0, 5.0, 1'000'000.0);
  EXPECT_EQ(watch(chip.ordered()).times, 0);
  for (const double sigma_px : {2.0, 5.0, 20.0}) {
    Stream spot(2);
    spot.light(0.0, 12.0, 50.0);
    spot.light_spot(2.0, 12.0, 30'000.0, 100, 120, sigma_px);
    EXPECT_EQ(watch(spot.ordered()).times, 0) << sigma_px;
  }
}

TEST(HotPixels, OneBigClusterMakesNone) {
  Stream stream(3);
  stream.light(0.0, 30.0, 10.0);
  for (int track = 0; track < 12; ++track) {  // muons and alphas across the same place
    for (int x = 50; x < 150; ++x) stream.add(1.0 + 2.0 * track, x, 80 + x % 3);
  }
  EXPECT_EQ(watch(stream.ordered()).times, 0);
}

TEST(HotPixels, ByChanceThereIsNone) {
  for (const double light_hits_s : {10.0, 1'000.0, 6'500.0, 13'000.0, 65'000.0}) {  // most often 2 to 20 per window
    Stream stream(4);
    stream.light(0.0, 100.0, light_hits_s);
    EXPECT_EQ(watch(stream.ordered()).times, 0) << light_hits_s;
  }
}

TEST(HotPixels, APixelThatIsQuietAgainIsReleased) {
  Stream stream(5);
  stream.light(0.0, 60.0, 1'000.0);
  stream.fire(0.0, 20.0, 100.0, 60, 60);
  stream.fire(30.0, 60.0, 0.5, 60, 60);
  const Outcome outcome = watch(stream.ordered());
  EXPECT_TRUE(outcome.masked.empty());
  EXPECT_EQ(outcome.times, 1);
  EXPECT_LE(outcome.kept_of(60, 60, 0.0, 30.0), 27);
  EXPECT_GT(outcome.kept_of(60, 60, 36.0), 5) << "its true hits count again";
}

TEST(HotPixels, APixelThatIsNotQuietEnoughStaysMasked) {
  Stream stream(9);
  stream.light(0.0, 60.0, 1'000.0);
  stream.fire(0.0, 10.0, 100.0, 60, 60);
  for (double t_s = 10.0; t_s < 60.0; t_s += 0.6) stream.add(t_s, 60, 60);  // 16 in a window
  const Outcome outcome = watch(stream.ordered());
  EXPECT_EQ(outcome.masked.size(), 1u);
  EXPECT_EQ(outcome.times, 1);
}

TEST(HotPixels, APixelThatGoesOnStaysMaskedUnderAnyLight) {
  Stream stream(6);
  stream.light(0.0, 20.0, 1'000.0);
  stream.light(20.0, 30.0, 200'000.0);
  stream.light(30.0, 60.0, 10.0);
  stream.fire(0.0, 60.0, 1'000.0, 60, 60);
  const Outcome outcome = watch(stream.ordered());
  EXPECT_EQ(outcome.times, 1);
  EXPECT_EQ(outcome.masked.size(), 1u);
}

TEST(HotPixels, ColumnsAndBlocksAreFoundAsAWhole) {
  Stream stream(7);
  stream.light(0.0, 10.0, 1'000.0);
  for (int y = 0; y < kChipPixels; ++y) {
    for (const int x : {90, 91}) stream.fire(1.0, 10.0, 30.0, x, y);
  }
  for (int i = 0; i < 25; ++i) stream.fire(1.0, 10.0, 30.0, 200 + i % 5, 200 + i / 5);
  EXPECT_EQ(watch(stream.ordered()).masked.size(), 2u * 256u + 25u);
}

TEST(HotPixels, APixelWhoseNeighboursAreDeadIsComparedWithTheChip) {
  HotPixels hot_pixels(HotPixelConfig{.window_s = 0.1});
  std::vector<Hit> hits;
  for (ChipTime t = 0; t < kSecond / 10; t += 40) {  // 12 hits a pixel in each half
    const auto pixel = static_cast<std::uint16_t>(40503 * (t / 40));
    const int dx = std::abs(pixel_x(pixel) - 100), dy = std::abs(pixel_y(pixel) - 100);
    const bool dead = dx <= 3 && dy <= 3 && dx + dy > 0;
    if (!dead) hits.push_back({.t = t, .pixel = pixel, .tot = 50});
  }
  for (int i = 1; i <= 8; ++i) hits.push_back({.t = kSecond / 10 + i, .pixel = pixel_at(100, 100), .tot = 50});
  EXPECT_TRUE(hot_pixels.split(hits, hits.back().t).left_out.empty());
}

TEST(HotPixels, WhatIsFoundDoesNotDependOnHowHitsAreCut) {
  Stream stream(8);
  stream.light(0.0, 40.0, 1'000.0);
  stream.fire(3.0, 15.0, 100.0, 60, 60);
  stream.fire(12.0, 40.0, 100.0, 61, 61);
  const Outcome whole = watch(stream.ordered(), stream.hits.size());
  EXPECT_EQ(whole.times, 2);
  for (const std::size_t step : {1u, 7u, 5000u}) EXPECT_EQ(watch(stream.ordered(), step), whole) << step;
}

TEST(HotPixels, ALongPauseReleasesAllAndChipTimeMayStartAgain) {
  HotPixels hot_pixels{HotPixelConfig{}};
  const auto burst = [&](ChipTime from) {
    std::vector<Hit> hits;
    for (int i = 0; i < 100; ++i) hits.push_back({.t = from + 1000 * i, .pixel = pixel_at(9, 9), .tot = 9});
    return hot_pixels.split(hits, hits.back().t).left_out.size();
  };
  EXPECT_EQ(burst(1'000'000 * kSecond), 77u);
  EXPECT_EQ(burst(1'000'003 * kSecond), 100u);
  EXPECT_EQ(burst(5 * kSecond), 100u) << "chip time started again: a new half, in which it is as hot";
  (void)hot_pixels.split({}, 20 * kSecond - 1);
  EXPECT_EQ(hot_pixels.masked().size(), 1u);
  (void)hot_pixels.split({}, 20 * kSecond);
  EXPECT_EQ(hot_pixels.masked().size(), 0u);
  EXPECT_EQ(burst(30 * kSecond), 77u);
  (void)hot_pixels.split({}, 60 * kSecond);
  EXPECT_EQ(hot_pixels.masked().size(), 0u);
}

TEST(HotPixels, ConfigurationsWithoutMeaningAreRefused) {
  EXPECT_THROW(check(HotPixelConfig{.window_s = 0.0}), std::invalid_argument);
  EXPECT_THROW(check(HotPixelConfig{.window_s = std::nan("")}), std::invalid_argument);
  EXPECT_THROW(check(HotPixelConfig{.times_around = 1.0}), std::invalid_argument);
  EXPECT_THROW(check(HotPixelConfig{.hits_min = 15}), std::invalid_argument);
  EXPECT_NO_THROW(check(HotPixelConfig{}));
}

}  // namespace
}  // namespace comptonaut
