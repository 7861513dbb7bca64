// SPDX-License-Identifier: BSD-3-Clause
// What the mapper accepts of EVENTS, and in which order: losses, disorder, restarts, clocks that are set.
#include <gtest/gtest.h>

#include "nodes/mapper_fixture.h"

namespace comptonaut {
namespace {

TEST(Mapper, TakesEachBatchOnceAndInOrder) {
  Mapper mapper(config(), kFirst);
  (void)fly(mapper, kStart_us, kStart_us + 40'000);
  for (const int number : {0, 2, 1, 2, 0}) EXPECT_TRUE(mapper.on_events(events(number)).empty()) << number;
  const auto released = fly(mapper, kStart_us + 60'000, kStart_us + 160'000);
  ASSERT_EQ(released.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(released[i].utime, kStart_us + static_cast<Utime>(i) * kBatch_us);
    EXPECT_EQ(released[i].key.number, static_cast<std::int64_t>(i));
  }
  EXPECT_TRUE(mapper.on_events(events(1)).empty());
  EXPECT_EQ(counter(mapper, "events_refused"), 3);
  EXPECT_EQ(counter(mapper, "events_reordered"), 1);
  EXPECT_EQ(counter(mapper, "events_missing"), 0);
}

TEST(Mapper, ShowsWhatEventsLostAsMissingLiveTime) {
  Mapper mapper(config(), kFirst);
  (void)fly(mapper, kStart_us, kStart_us + 600'000);
  std::int64_t live_us = 0, number = 0;
  for (const int i : {0, 1, 4, 5}) {
    for (const auto& batch : mapper.on_events(events(i))) {
      live_us += batch.live_us;
      EXPECT_EQ(batch.key.number, number++);
    }
  }
  EXPECT_EQ(live_us, 4 * 49'000);
  EXPECT_EQ(counter(mapper, "events_missing"), 2);
}

TEST(Mapper, FollowsADetectorReaderThatStartedAgain) {
  Mapper mapper(config(), kFirst);
  (void)fly(mapper, kStart_us, kStart_us + 600'000);
  EXPECT_EQ(mapper.on_events(events(7)).size(), 1u);
  EventBatch again = events(8);
  again.key.boot_epoch = 6;
  again.key.number = 0;
  EXPECT_EQ(mapper.on_events(again).size(), 1u);
  EXPECT_TRUE(mapper.on_events(events(9)).empty()) << "the process before it is gone";
  EXPECT_EQ(counter(mapper, "events_missing"), 0);
}

/// Events of a detector-reader that started when the wall clock had been set back by `set_back_s`.
EventBatch events_after_set_back(std::int64_t number, std::int64_t set_back_s) {
  EventBatch batch = events(number, {pair_at(5)});
  batch.key.boot_epoch = 5 - set_back_s;
  batch.utime -= set_back_s * kSecond_us;
  return batch;
}

TEST(Mapper, FollowsADetectorReaderThatStartedAgainAfterTheClockWasSetBack) {
  for (const std::int64_t set_back_s : {1, 600}) {
    Mapper mapper(config(), kFirst);
    (void)fly(mapper, kStart_us, kStart_us + 600'000);
    for (int i = 0; i < 10; ++i) EXPECT_EQ(mapper.on_events(events(i)).size(), 1u);
    std::int64_t live_us = 0, number = 10;
    Utime posed = kStart_us - set_back_s * kSecond_us;
    for (int i = 0; i < 200; ++i) {
      auto released = mapper.on_events(events_after_set_back(i, set_back_s));
      const Utime until = events_after_set_back(i, set_back_s).utime + kBatch_us + 20'000;
      append(released, fly(mapper, posed, until));  // each batch comes before its poses
      posed = until + 20'000;
      for (const MeasurementBatch& batch : released) {
        EXPECT_EQ(batch.key.number, number++);
        live_us += batch.live_us;
      }
    }
    EXPECT_EQ(live_us, 200 * 49'000) << set_back_s;
    EXPECT_EQ(mapper.utime(), kStart_us - set_back_s * kSecond_us + 200 * kBatch_us);
    EXPECT_TRUE(mapper.on_events(events(10)).empty()) << "of the process before";
    EXPECT_EQ(counter(mapper, "events_refused"), 1) << set_back_s;
    EXPECT_EQ(counter(mapper, "events_missing"), 0) << set_back_s;
  }
}

TEST(Mapper, PutsLateEventsOfAProcessBeforeThoseOfTheNextWhileTheseStillWait) {
  for (const std::int64_t next_epoch : {6, 4}) {
    Mapper mapper(config(), kFirst);
    EventBatch next = events(5);
    next.key.boot_epoch = next_epoch;
    next.key.number = 0;
    for (const EventBatch& batch : {events(0), events(2), next, events(1), events(2)}) {
      EXPECT_TRUE(mapper.on_events(batch).empty());
    }
    std::vector<Utime> slots;
    for (const MeasurementBatch& batch : fly(mapper, kStart_us, kStart_us + 10 * kBatch_us)) {
      EXPECT_EQ(batch.key.number, std::ssize(slots));
      slots.push_back((batch.utime - kStart_us) / kBatch_us);
    }
    EXPECT_EQ(slots, (std::vector<Utime>{0, 1, 2, 5})) << "next epoch " << next_epoch;
    for (const int late : {1, 3}) EXPECT_TRUE(mapper.on_events(events(late)).empty()) << late;
    EXPECT_EQ(counter(mapper, "events_refused"), 3);
  }
}

TEST(Mapper, RefusesEventsOfOthers) {
  Mapper mapper(config(), kFirst);
  EventBatch other_mav = events(0), other_mission = events(0);
  other_mav.key.sender = 3;
  other_mission.key.mission = 2;
  EXPECT_TRUE(mapper.on_events(other_mav).empty());
  EXPECT_TRUE(mapper.on_events(other_mission).empty());
  EXPECT_EQ(counter(mapper, "events_of_others"), 2);
}

}  // namespace
}  // namespace comptonaut
