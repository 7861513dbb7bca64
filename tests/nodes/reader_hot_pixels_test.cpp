// SPDX-License-Identifier: BSD-3-Clause
// What a hot pixel does to the batches of a detector-reader, and what it says of it.
#include <gtest/gtest.h>

#include <algorithm>

#include "nodes/reader_fixture.h"

namespace comptonaut {
namespace {

/// 200 photons a second for 30 s, and from the fifth second to the tenth a pixel that fires 10,000 times a second.
std::string rows() {
  std::vector<Hit> hits;
  for (int i = 0; i < 6000; ++i) hits.push_back(make_hit_anywhere(i, 300.0, 5e6 * i + 1e3));
  for (int i = 0; i < 50'000; ++i) hits.push_back(make_hit(77, 200, 300.0, 5e9 + 1e5 * i));
  std::stable_sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) { return a.t < b.t; });
  return kStamp + t3pa_text(hits);
}

std::int64_t value(const DetectorReader& reader, const std::string& name) {
  const auto counters = reader.counters();
  return std::find_if(counters.begin(), counters.end(), [&](const Counter& c) { return c.name == name; })->value;
}

std::string stream_of_rows() {
  std::string text = rows();
  return text.erase(kStamp.size(), kT3paHeader.size());
}

TEST(ReaderHotPixels, AreLeftOutCountedAndReleased) {
  auto reader = new_reader();
  Batches batches;
  const std::string text = stream_of_rows();
  std::int64_t most_hot = 0;
  for (std::size_t i = 0; i < text.size(); i += 10'000) {
    batches.add(reader.on_bytes(std::span(text).subspan(i, std::min<std::size_t>(10'000, text.size() - i))));
    most_hot = std::max(most_hot, value(reader, "pixels_hot"));
  }
  batches.add(reader.on_bytes(alive(30.0)));
  EXPECT_NEAR(batches.singles(), 6000 + 23, 10) << "of the hot one its first hits";
  EXPECT_EQ(value(reader, "hits"), 56'000);
  EXPECT_EQ(value(reader, "hits_of_hot_pixels"), 50'000 - 23);
  EXPECT_EQ(value(reader, "pixels_hot_times"), 1);
  EXPECT_EQ(most_hot, 1);
  EXPECT_EQ(value(reader, "pixels_hot"), 0) << "quiet for a window";
}

TEST(ReaderHotPixels, CountForTheRateAndTheirPixelIsBlind) {
  auto reader = new_reader();
  Batches batches;
  batches.add(reader.on_bytes(stream_of_rows()));
  batches.add(reader.on_bytes(alive(8.0)));
  const auto live_of = [&](double t_s) {
    const Utime utime = kReaderStart + microseconds(t_s);
    return std::find_if(batches.all.begin(), batches.all.end(),
                        [&](const EventBatch& b) { return b.utime <= utime && utime < b.utime + kBatch_us; })
        ->live_us;
  };
  EXPECT_LE(std::abs(live_of(8.0) - live_of(3.0)), 1) << "one pixel of 65,536, and no pile-up with its hits";
  auto stopped = new_reader();
  std::string until_8_s = stream_of_rows();
  (void)stopped.on_bytes(until_8_s.erase(until_8_s.size() * 6 / 10));
  EXPECT_NEAR(static_cast<double>(value(stopped, "rate_hits_s")), 10'200, 100);
}

TEST(ReaderHotPixels, MakeTheSameBatchesHoweverTheBytesAreCut) {
  const std::string text = stream_of_rows();
  const auto singles = [&](std::size_t step) {
    auto reader = new_reader();
    Batches batches;
    for (std::size_t i = 0; i < text.size(); i += step) {
      batches.add(reader.on_bytes(std::span(text).subspan(i, std::min(step, text.size() - i))));
    }
    batches.add(reader.on_end());
    std::vector<std::pair<int, int>> all;
    for (const EventBatch& batch : batches.all) all.emplace_back(batch.channels[0].singles, batch.live_us);
    return all;
  };
  const auto whole = singles(text.size());
  EXPECT_EQ(singles(1000), whole);
  EXPECT_EQ(singles(77'777), whole);
}

TEST(ReaderHotPixels, PixelsWithoutCalibrationAreBlindToo) {
  std::vector<PixelCalibration> pixels(Calibration::kPixels, {.a = 1.15, .b = 7.1, .c = 2.0, .t = 3.95});
  std::fill_n(pixels.begin(), Calibration::kPixels / 4, PixelCalibration{});
  DetectorReader reader({}, Calibration(pixels), kReaderKey);
  Batches batches;
  batches.add(reader.on_bytes(kStamp + alive(0.5) + single(0, 0.6) + alive(1.0)));
  EXPECT_NEAR(static_cast<double>(batches.all[5].live_us), 0.75 * kBatch_us, 5.0);
}

}  // namespace
}  // namespace comptonaut
