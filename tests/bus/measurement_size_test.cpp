// SPDX-License-Identifier: BSD-3-Clause
// The fullest batches that a mapper sends fit a datagram of the team bus, whatever they hold.
#include <gtest/gtest.h>

#include "bus/codec.h"
#include "bus/samples.h"
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

}  // namespace
}  // namespace comptonaut
