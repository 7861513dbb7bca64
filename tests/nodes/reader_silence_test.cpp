// SPDX-License-Identifier: BSD-3-Clause
// The detector-reader of a source that sends rows alone, when none come for a while.
#include <gtest/gtest.h>

#include "core/random.h"
#include "nodes/reader_fixture.h"

namespace comptonaut {
namespace {

constexpr double kTick_s = 0.01;

/// What leaves of rows at these times when each comes at once, with a tick of the silence's clock in between.
Batches play(DetectorReader& reader, const std::vector<double>& times_s, double end_s, bool ticks) {
  Batches batches;
  batches.add(reader.on_bytes(kT3paHeader + kStamp));
  double newest_s = 0.0, tick_s = 0.0;
  std::size_t next = 0;
  while (next < times_s.size() || tick_s < end_s) {
    if (next < times_s.size() && times_s[next] <= tick_s) {
      newest_s = times_s[next];
      batches.add(reader.on_bytes(single(static_cast<std::int64_t>(next), newest_s)));
      ++next;
      continue;
    }
    if (ticks && newest_s > 0.0) batches.add(reader.on_silence(1e3 * (tick_s - newest_s)));
    tick_s += kTick_s;
  }
  return batches;
}

TEST(ReaderSilence, ABatchLeavesWithin200MsOfItsNewestHit) {
  Random random(1);
  for (int trial = 0; trial < 200; ++trial) {
    auto reader = new_reader();
    Batches batches;
    batches.add(reader.on_bytes(kStamp));
    const double t_s = random.uniform(0.001, 0.4);
    batches.add(reader.on_bytes(single(1, t_s)));
    double silent_ms = 0.0;
    while (batches.singles() == 0 && silent_ms < 1000.0) batches.add(reader.on_silence(silent_ms += 1e3 * kTick_s));
    EXPECT_LE(silent_ms, 170.0) << "hit at " << t_s << " s";
    EXPECT_GT(silent_ms, 100.0) << "rows may take that long: hit at " << t_s << " s";
  }
}

TEST(ReaderSilence, ChangesWhenABatchLeavesButNotWhatIsInIt) {
  Random random(2);
  std::vector<double> times_s;
  for (double t_s = 0.05; t_s < 20.0; t_s += random.uniform(0.0, 0.45)) times_s.push_back(t_s);
  auto with = new_reader(), without = new_reader();
  Batches ticked = play(with, times_s, 20.0, true), plain = play(without, times_s, 20.0, false);
  EXPECT_GT(ticked.all.size(), plain.all.size()) << "those of the end have left";
  plain.add(without.on_end());
  ASSERT_GE(ticked.all.size() + 1, plain.all.size());
  for (std::size_t i = 0; i + 10 < plain.all.size(); ++i) {
    EXPECT_EQ(ticked.all[i].key.number, plain.all[i].key.number);
    EXPECT_EQ(ticked.all[i].utime, plain.all[i].utime) << i;
    EXPECT_EQ(ticked.all[i].channels, plain.all[i].channels) << i;
    EXPECT_EQ(ticked.all[i].live_us, plain.all[i].live_us) << i;
  }
}

TEST(ReaderSilence, ADetectorThatSeesNothingLivesAndOneThatSaysNothingForLongIsDead) {
  auto reader = new_reader();
  Batches batches = play(reader, {0.1, 2.1}, 4.0, true);
  EXPECT_NEAR(1e-6 * static_cast<double>(batches.live_us()), 4.0 - 0.13, 0.06) << "3 s between hits are ordinary";

  auto dead = new_reader();
  batches = play(dead, {0.1, 9.0, 9.1}, 9.1, true);
  batches.add(dead.on_end());
  // 0.1 s, then quiet_max_ms less what rows may be late, then from the next row on
  EXPECT_NEAR(1e-6 * static_cast<double>(batches.live_us()), 0.1 + 4.9 + 0.1, 0.02);
  EXPECT_EQ(batches.singles(), 3);
}

TEST(ReaderSilence, ALongDeathIsNotToldInAFloodOfEmptyBatches) {
  auto reader = new_reader();
  Batches batches = play(reader, {0.1, 50.0, 50.1, 50.2}, 50.2, true);
  batches.add(reader.on_end());
  EXPECT_LT(batches.all.size(), 5.2 / 0.05 + 10) << "some 5 s of life and the end";
  EXPECT_EQ(batches.singles(), 4);
  const auto number = batches.all.back().key.number;
  EXPECT_EQ(number + 1, std::ssize(batches.all)) << "none is missing";
  EXPECT_EQ(batches.all.back().utime, floor_to(kReaderStart + 50'200'000, kBatch_us));
}

TEST(ReaderSilence, OfThirtyDaysInARecordingIsDeadAndNoFloodEither) {
  auto reader = new_reader();
  reader.on_open({.recording = true, .start_utime = kReaderStart});
  Batches batches;
  std::string rows = single(0, 0.1);
  for (int i = 1; i <= 4; ++i) rows += single(i, 30.0 * 86400.0 + 0.1 * i);
  batches.add(reader.on_bytes(rows));
  batches.add(reader.on_end());
  EXPECT_EQ(batches.singles(), 5);
  EXPECT_LT(batches.all.size(), 120u) << "some 5 s of life and the end";
  EXPECT_NEAR(1e-6 * static_cast<double>(batches.live_us()), 0.1 + 5.0 + 0.3, 0.06);
  EXPECT_EQ(batches.all.back().utime, floor_to(kReaderStart + 30 * 86400 * kSecond_us + 400'000, kBatch_us));
}

TEST(ReaderSilence, DoesNothingToAStreamThatTellsItsOwnTime) {
  auto reader = new_reader();
  EXPECT_EQ(reader.on_bytes(kStamp + alive(0.031)).size(), 0u);
  EXPECT_TRUE(reader.on_silence(60e3).empty());
  EXPECT_EQ(reader.on_bytes(single(0, 0.032) + alive(0.05)).size(), 1u);
  EXPECT_EQ(reader.counts().faults.total(), 0) << "the row came after a minute, but in time";
}

TEST(ReaderSilence, RowsAfterAHiccupAreCountedAsLateAndTheStreamGoesOn) {
  auto reader = new_reader();
  Batches batches;
  batches.add(reader.on_bytes(kStamp + single(0, 0.1)));
  for (int i = 1; i <= 100; ++i) batches.add(reader.on_silence(10.0 * i));
  std::string rows;
  for (int i = 1; i <= 20; ++i) rows += single(i, 0.1 + 0.1 * i);  // the first eight are older than what has left
  batches.add(reader.on_bytes(rows));
  batches.add(reader.on_end());
  EXPECT_EQ(reader.counts().epochs, 1);
  EXPECT_EQ(reader.counts().faults.of(RowFault::kLate), 8);
  EXPECT_EQ(batches.singles(), 21 - 8);
  for (std::size_t i = 1; i < batches.all.size(); ++i) {
    EXPECT_EQ(batches.all[i].utime, batches.all[i - 1].utime + kBatch_us) << "each once, none left out";
  }
}

TEST(ReaderSilence, OfASourceThatHandsOverBlocksTheFirstOfEachMinuteIsLate) {
  Random random(3);
  for (const double block_s : {0.08, 0.25, 0.6}) {
    auto reader = new_reader();
    Batches batches;
    batches.add(reader.on_bytes(kStamp));
    std::string rows;
    int sent = 0;
    double tick_s = 0.0, came_s = 0.0;
    for (double t_s = 0.01; t_s < 100.0; t_s += random.exponential() / 50.0) {
      for (; tick_s < t_s; tick_s += kTick_s) {
        if (tick_s < came_s + block_s || rows.empty()) {
          if (came_s > 0.0) batches.add(reader.on_silence(1e3 * (tick_s - came_s)));
          continue;
        }
        batches.add(reader.on_bytes(std::exchange(rows, {})));
        came_s = tick_s;
      }
      rows += single(sent++, t_s);
    }
    batches.add(reader.on_bytes(rows));
    batches.add(reader.on_end());
    const std::int64_t late = reader.counts().faults.of(RowFault::kLate);
    EXPECT_EQ(batches.singles() + late, sent) << block_s;
    EXPECT_EQ(late > 0, block_s > 0.2) << block_s;
    EXPECT_LT(late, 2.5 * 50.0 * block_s) << block_s;
    const double missed_s = static_cast<double>(late) / 50.0;
    EXPECT_NEAR(1e-6 * static_cast<double>(batches.live_us()), 100.0 - missed_s, 0.1 + 0.2 * missed_s) << block_s;
  }
}

TEST(ReaderSilence, AnEpochThatBeginsAfterAPauseComesAfterWhatHasLeft) {
  auto reader = new_reader();
  Batches batches;
  batches.add(reader.on_bytes(kStamp + single(0, 0.1)));
  for (int i = 1; i <= 100; ++i) batches.add(reader.on_silence(10.0 * i));
  batches.add(reader.on_bytes(kT3paHeader + single(0, 0.1)));  // nothing tells its UTC
  batches.add(reader.on_end());
  EXPECT_EQ(batches.singles(), 2);
  for (std::size_t i = 1; i < batches.all.size(); ++i) {
    EXPECT_GE(batches.all[i].utime, batches.all[i - 1].utime) << i;
  }
}

TEST(ReaderSilence, AGapOfLostDataThatIsOpenIsDeadTime) {
  auto reader = new_reader();
  Batches batches;
  batches.add(reader.on_bytes(kStamp + single(0, 0.1) + "1 116 4000000 0 0 1\n"));  // from 0.1 s on
  for (int i = 1; i <= 60; ++i) batches.add(reader.on_silence(10.0 * i));
  EXPECT_GT(batches.all.size(), 8u);
  EXPECT_NEAR(static_cast<double>(batches.live_us()), 100e3, 1.0);
}

}  // namespace
}  // namespace comptonaut
