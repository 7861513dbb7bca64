// SPDX-License-Identifier: BSD-3-Clause
// The largest messages that a mapper and a coordinator send fit a datagram of the team bus, whatever they hold.
#include <gtest/gtest.h>

#include "bus/codec.h"
#include "bus/samples.h"
#include "nodes/batch_ledger.h"
#include "nodes/mapper.h"

namespace comptonaut {
namespace {

constexpr std::size_t kDatagram_bytes = 1200;
constexpr std::size_t kTrailer_bytes = 64;

TEST(MeasurementSize, FitsADatagramWithItsTrailer) {
  EventBatch events = sample<EventBatch>();
  events.channels = {{"Cs-137", 1, 1}, {"Co-60-1173", 2, 2}, {"Co-60-1333", 3, 3}, {"I-131", 4, 4}, {"Ba-133", 5, 5}};
  events.pairs.assign(300, events.pairs.front());
  Mapper mapper({}, events.key);
  (void)mapper.on_pose({.utime = events.utime - 1});
  (void)mapper.on_pose({.utime = events.utime + kBatch_us + 1});
  const auto batches = mapper.on_events(events);
  ASSERT_EQ(batches.size(), 30u);
  for (const MeasurementBatch& batch : batches) {
    const Bytes bytes = encode(batch);
    EXPECT_LE(bytes.size() + kTrailer_bytes, kDatagram_bytes);
    EXPECT_TRUE(decode<MeasurementBatch>(bytes));
  }
}

TEST(MeasurementSize, MeasurementsOfRoundedInputsAreAcceptedByTheReceiver) {
  // A quaternion and axes that just pass the receiver's check of unit length must not fail the next one's.
  EventBatch events = sample<EventBatch>();
  for (PairEvent& pair : events.pairs) pair.a.axis_D *= 1.0 + 9e-7;
  Mapper mapper({}, events.key);
  for (const Utime utime : {events.utime, events.utime + kBatch_us}) {
    StampedPose pose{.utime = utime, .q_WB = {0.5, 0.5, 0.5, 0.5}};
    pose.q_WB.coeffs() *= 1.0 + 9e-7;
    (void)mapper.on_pose(pose);
  }
  const auto batches = mapper.on_events(*decode<EventBatch>(encode(events)));
  ASSERT_EQ(batches.size(), 1u);
  EXPECT_TRUE(decode<MeasurementBatch>(encode(batches.front())));
}

/// A second of a team whose mappers start again five times a second, lose every second batch, and have each a clock
/// that goes backwards from start to start.
void enter_a_second_of_mishaps(BatchLedger& ledger, int mavs, int second) {
  for (int number = 20 * second; number < 20 * (second + 1); ++number) {
    for (int mav = 1; mav <= mavs; ++mav) {
      MeasurementBatch batch{.utime = kSampleUtime + number * kBatch_us};
      batch.key = {.sender = mav, .boot_epoch = kSampleUtime - number / 4, .number = 2 * (number % 4)};
      ledger.enter(batch);
    }
  }
}

TEST(PlanSize, FitsADatagramWithItsTrailerForEveryTeamThroughRestartsAndLosses) {
  Plan plan = sample<Plan>();
  plan.waypoints.assign(16, plan.waypoints.back());
  plan.status = "no way to waypoint (-100000.0, -100000.0)";
  CoordinatorState state = sample<CoordinatorState>();
  for (const int mavs : {3, 6, 15}) {
    BatchLedger ledger(3 * kSecond_us, mavs);
    std::size_t largest = 0;
    std::int64_t folded = 0;
    for (int second = 0; second < 60; ++second) {
      enter_a_second_of_mishaps(ledger, mavs, second);
      const auto fold = ledger.fold_until(kSampleUtime + (second + 1) * kSecond_us);
      folded += std::ssize(fold.batches);
      plan.basis = fold.newest;
      state.basis = fold.basis;
      for (const Bytes& bytes : {encode(plan), encode(state)}) {
        largest = std::max(largest, bytes.size());
        ASSERT_LE(bytes.size() + kTrailer_bytes, kDatagram_bytes) << mavs << " MAVs, after " << second << " s";
      }
      EXPECT_TRUE(decode<Plan>(encode(plan)));
      EXPECT_TRUE(decode<CoordinatorState>(encode(state)));
    }
    EXPECT_GE(largest + kTrailer_bytes, kDatagram_bytes - 200) << "it was no test";
    EXPECT_GT(folded, 60) << "the team's work goes on";
  }
}

}  // namespace
}  // namespace comptonaut
