// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/detector_reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "config/config.h"
#include "core/random.h"
#include "nodes/reader_fixture.h"

namespace comptonaut {
namespace {

/// Singles, pairs and others at random times up to `end_s`, with an alive line every 20 ms.
std::string random_stream(std::uint64_t seed, double rate_hz, double end_s) {
  Random random(seed);
  std::string text = kT3paHeader + kStamp;
  std::int64_t index = 0;
  double next_alive_s = 0.02;
  for (double t_s = random.exponential() / rate_hz; t_s < end_s; t_s += random.exponential() / rate_hz) {
    for (; next_alive_s < t_s; next_alive_s += 0.02) text += alive(next_alive_s);
    const int x = static_cast<int>(random.uniform(5.0, 100.0)), y = static_cast<int>(random.uniform(5.0, 250.0));
    const double kind = random.uniform();
    if (kind < 0.8) {
      text += t3pa_row(index++, make_hit(x, y, random.uniform(60.0, 600.0), 1e9 * t_s));
    } else if (kind < 0.9) {
      text += t3pa_row(index++, make_hit(x, y, 300.0, 1e9 * t_s));
      text += t3pa_row(index++, make_hit(x + 50, y, 361.0, 1e9 * t_s + 30.0));
    } else {
      text += t3pa_row(index++, make_hit(x, y, 20.0, 1e9 * t_s));
    }
  }
  return text + alive(end_s);
}

/// The same with so many of its rows out of ten spoilt, each in one of several ways.
std::string spoilt(const std::string& text, double share, Random& random) {
  std::string spoilt;
  std::istringstream in(text);
  int way = 0;
  for (std::string line; std::getline(in, line); spoilt += line + "\n") {
    if (line.empty() || line[0] < '0' || line[0] > '9' || random.uniform() >= share) continue;
    if (way == 0) line = "1 70000 9 50 0 0";
    if (way == 1) line += " 7";
    if (way == 2) line[0] = '\xff';
    way = (way + 1) % 3;
  }
  return spoilt;
}

struct Sums {
  std::int64_t singles = 0, pairs = 0, others = 0, live_us = 0;
  bool operator==(const Sums&) const = default;
};

Sums sum(const std::vector<EventBatch>& batches) {
  Sums sums;
  for (const EventBatch& batch : batches) {
    sums.singles += batch.channels[0].singles;
    sums.pairs += batch.channels[0].pairs;
    sums.others += batch.others;
    sums.live_us += batch.live_us;
    EXPECT_EQ(batch.channels[0].pairs, std::ssize(batch.pairs));
  }
  return sums;
}

std::vector<EventBatch> read(DetectorReader& reader, const std::string& text, std::size_t cut = 1 << 20) {
  std::vector<EventBatch> batches;
  const auto keep = [&](std::vector<EventBatch> more) { batches.insert(batches.end(), more.begin(), more.end()); };
  for (std::size_t at = 0; at < text.size(); at += cut) {
    keep(reader.on_bytes(std::span(text).subspan(at, std::min(cut, text.size() - at))));
  }
  keep(reader.on_end());
  return batches;
}

/// Of photons at this rate, those with none other in their coincidence window before and after.
double seen_share(double rate_hz) { return std::exp(-2.0 * rate_hz * 1e-9 * max_drift_ns(SensorConfig{})); }

TEST(DetectorReader, BatchesAreCompleteAlignedAndNumbered) {
  auto reader = new_reader();
  const auto batches = read(reader, random_stream(1, 5000.0, 2.0));
  ASSERT_EQ(batches.size(), 41u);  // 2 s that begin 20 ms into a batch
  for (std::size_t i = 0; i < batches.size(); ++i) {
    EXPECT_EQ(batches[i].key.number, static_cast<std::int64_t>(i));
    EXPECT_EQ(batches[i].key.sender, 2);
    EXPECT_EQ(batches[i].utime, kReaderStart - 20'000 + static_cast<Utime>(i) * kBatch_us) << i;
    const double length_us = i == 0 ? 30e3 : i == 40 ? 20e3 : 50e3;
    EXPECT_NEAR(batches[i].live_us, seen_share(5000.0) * length_us, 2e-4 * length_us) << i;
  }
  EXPECT_EQ(reader.utime(), batches.back().utime + kBatch_us);
}

TEST(DetectorReader, TheSumOfAllBatchesIsTheStream) {
  auto reader = new_reader();
  const std::string text = random_stream(2, 20000.0, 1.0);
  const Sums sums = sum(read(reader, text));
  EventFinder finder(EventRules{}, typical_calibration());
  HitStream stream({}, finder.quiet(), true);
  EXPECT_NEAR(static_cast<double>(sums.live_us), 1e6 * seen_share(20e3), 300.0);
  Sums expected{.live_us = sums.live_us};
  const auto drain = [&] {
    while (const auto part = stream.next()) {
      for (const DetectorEvent& event : finder.find(part->hits)) {
        expected.singles += event.kind == EventKind::kSingle;
        expected.pairs += event.kind == EventKind::kPair;
        expected.others += event.kind == EventKind::kOther;
      }
    }
  };
  stream.feed(text);
  drain();
  stream.end();
  drain();
  EXPECT_EQ(sums, expected);
  EXPECT_GT(sums.pairs, 1000);
}

TEST(DetectorReader, RefusedRowsCostTheirShareOfTheLiveTime) {
  const std::string text = random_stream(5, 2000.0, 10.0);
  Random random(6);
  auto reader = new_reader();
  const Sums all = sum(read(reader, text));
  for (const double share : {0.02, 0.2, 0.4}) {
    auto spoilt_reader = new_reader();
    const Sums left = sum(read(spoilt_reader, spoilt(text, share, random)));
    ASSERT_NEAR(static_cast<double>(spoilt_reader.counts().faults.hits_lost()), share * 22'000.0, 400.0);
    const double live_share = static_cast<double>(left.live_us) / static_cast<double>(all.live_us);
    const double others_share = static_cast<double>(left.others) / static_cast<double>(all.others);  // of one row each
    EXPECT_NEAR(live_share, 1.0 - share, 0.01);
    EXPECT_NEAR(others_share / live_share, 1.0, 0.05) << "the rate stays";
  }
}

TEST(DetectorReader, AnyCutOfTheBytesGivesTheSameBatches) {
  Random random(9);
  const std::string text = spoilt(random_stream(3, 3000.0, 0.7), 0.1, random);
  auto whole_reader = new_reader();
  const auto whole = read(whole_reader, text);
  for (const std::size_t cut : {1u, 13u, 400u, 7000u}) {
    auto reader = new_reader();
    const auto pieces = read(reader, text, cut);
    ASSERT_EQ(pieces.size(), whole.size()) << cut;
    for (std::size_t i = 0; i < whole.size(); ++i) {
      EXPECT_EQ(pieces[i].channels, whole[i].channels) << cut << ", batch " << i;
      EXPECT_EQ(pieces[i].live_us, whole[i].live_us) << cut << ", batch " << i;
      ASSERT_EQ(pieces[i].pairs.size(), whole[i].pairs.size()) << cut << ", batch " << i;
      for (std::size_t k = 0; k < whole[i].pairs.size(); ++k) {
        EXPECT_EQ(pieces[i].pairs[k].offset_ns, whole[i].pairs[k].offset_ns) << cut << ", batch " << i;
      }
    }
  }
}

TEST(DetectorReader, ABatchLeavesSoonAfterItsEnd) {
  auto reader = new_reader();
  EXPECT_TRUE(reader.on_bytes(kT3paHeader + kStamp + alive(0.030)).empty());
  EXPECT_EQ(reader.on_bytes(alive(0.035)).size(), 1u) << "5 ms after its end at 30 ms";
}

TEST(DetectorReader, EmptyBatchesTellThatNothingWasHit) {
  auto reader = new_reader();
  std::string text = kStamp;
  for (int i = 1; i <= 50; ++i) text += alive(0.02 * i);
  const auto batches = read(reader, text);
  ASSERT_EQ(batches.size(), 21u);
  EXPECT_EQ(sum(batches), (Sums{.live_us = 1'000'000}));
}

TEST(DetectorReader, SilenceAndLostDataAreNoLiveTime) {
  auto reader = new_reader();
  const std::string lost = "0 116 0 0 0 1\n1 117 800000 0 0 1\n";  // 20 ms
  const Sums sums = sum(read(reader, kStamp + alive(0.1) + lost + alive(0.2) + alive(2.0) + alive(2.1)));
  EXPECT_EQ(sums.live_us, 100'000 + 80'000 + 100'000);
}

TEST(DetectorReader, APairLandsInItsBatchAtItsTime) {
  auto reader = new_reader();
  const std::string text = kStamp + t3pa_row(0, make_hit(10, 10, 300.0, 31e6)) +
                           t3pa_row(1, make_hit(90, 10, 361.657, 31e6 + 20.0)) + alive(0.2);
  const auto batches = read(reader, text);
  ASSERT_GE(batches.size(), 2u);
  ASSERT_EQ(batches[1].pairs.size(), 1u) << "31 ms after a start 20 ms into a batch";
  EXPECT_NEAR(batches[1].pairs[0].offset_ns, 1e6, 5.0);
  EXPECT_NEAR(batches[1].pairs[0].e1_keV, 300.0, 1.0);
}

TEST(DetectorReader, AReconnectedStreamGoesOnWithTheNextNumber) {
  auto reader = new_reader();
  const auto first = read(reader, random_stream(4, 1000.0, 0.5));
  const auto second = read(reader, random_stream(5, 1000.0, 0.5));
  ASSERT_FALSE(second.empty());
  EXPECT_EQ(second.front().key.number, first.back().key.number + 1);
}

TEST(DetectorReader, UtcComesFromTheStreamElseFromItsOrigin) {
  const std::string rows = t3pa_row(0, make_hit(10, 10, 300.0, 5e9)) + t3pa_row(1, make_hit(10, 10, 300.0, 5.1e9));
  auto recording = new_reader();
  recording.on_open({.recording = true, .start_utime = kReaderStart});
  EXPECT_EQ(read(recording, rows).front().utime, floor_to(kReaderStart, kBatch_us));
  auto arrival = new_reader();
  const auto batches = arrival.on_bytes(rows, kReaderStart);
  const auto hit =
      std::find_if(batches.begin(), batches.end(), [](const auto& b) { return b.channels[0].singles > 0; });
  ASSERT_NE(hit, batches.end());
  EXPECT_EQ(hit->utime, floor_to(kReaderStart - 100'000, kBatch_us)) << "the newest of the rows took no time to come";
  auto nothing = new_reader();
  EXPECT_TRUE(read(nothing, rows).empty());
  EXPECT_EQ(nothing.counts().faults.of(RowFault::kNoTimeBase), 2);
}

TEST(DetectorReader, MutatedStreamsNeverThrowAndLiveTimeStaysWithinItsBatch) {
  Random random(6);
  const std::string right = random_stream(7, 500.0, 0.5);
  for (int trial = 0; trial < 100; ++trial) {
    std::string text = right;
    for (int k = 0; k < 1 + trial % 30; ++k) {
      const auto at = static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(text.size())));
      if (random() % 2 == 0) {
        text[at] = static_cast<char>(random() & 0xff);
      } else {
        text.insert(at, std::to_string(random() % 1'000'000'000));
      }
    }
    auto reader = new_reader();
    for (const EventBatch& batch : read(reader, text, 1 + random() % 3000)) {
      EXPECT_GE(batch.live_us, 0) << "trial " << trial;
      EXPECT_LE(batch.live_us, batch.duration_us) << "trial " << trial;
      EXPECT_EQ(batch.utime % kBatch_us, 0) << "trial " << trial;
    }
  }
}

TEST(DetectorReaderConfig, TheShippedNuclidesAreRead) {
  const std::string folder = std::string(COMPTONAUT_SOURCE_DIR) + "/config/x.yaml";
  const auto config =
      parse_config("mission: 4\nnuclides: [{file: nuclides/cs-137.yaml}]\n", folder, read_detector_reader_config);
  ASSERT_EQ(config.rules.channels.size(), 1u);
  EXPECT_EQ(config.rules.channels[0].name, "Cs-137");
  EXPECT_EQ(config.rules.channels[0].line_keV, NuclideChannel{}.line_keV);
  EXPECT_THROW((void)parse_config("mission: 4\n", folder, read_detector_reader_config), ConfigError);
  EXPECT_THROW(
      (void)parse_config("mission: 4\nnuclides: [{file: nuclides/cs-137.yaml}, {file: nuclides/cs-137.yaml}]\n", folder,
                         read_detector_reader_config),
      ConfigError)
      << "two channels with the same window";
}

}  // namespace
}  // namespace comptonaut
