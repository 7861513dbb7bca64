// SPDX-License-Identifier: BSD-3-Clause
#include "mavlink/mavlink.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <string>

#include "core/random.h"

namespace comptonaut {
namespace {

using Bytes = std::vector<std::uint8_t>;

Odometry odometry() {
  Odometry m{.time_usec = 1'700'000'000'123'456,
             .position_m = {10, -20, -2.5},
             .q = {0.5, 0.5, -0.5, 0.5},
             .velocity_m_s = {1, 2, 3},
             .rates_rad_s = {0.125, 0.25, 0.5},
             .reset_counter = 3,
             .quality = -1};
  std::iota(m.pose_covariance.begin(), m.pose_covariance.end(), 0.0F);
  std::transform(m.pose_covariance.begin(), m.pose_covariance.end(), m.velocity_covariance.begin(),
                 [](float c) { return 0.0F - c; });
  return m;
}

SetPositionTarget target() {
  return {.time_boot_ms = 0x01020304,
          .target_system = 7,
          .target_component = 1,
          .type_mask = kIgnoreYaw | kIgnoreYawRate,
          .position_m = {1.5, -2, 3},
          .velocity_m_s = {4, 5, 6},
          .acceleration_m_s2 = {7, 8, 9},
          .yaw_rad = 0.25,
          .yaw_rate_rad_s = -0.5};
}

const SysStatus kSysStatus{.sensors_present = 3,
                           .sensors_enabled = 2,
                           .sensors_health = 1,
                           .load = 250,
                           .voltage_battery_mV = 15'800,
                           .current_battery_cA = 1'234,
                           .drop_rate_comm = 5,
                           .errors_comm = 6,
                           .errors_count = {7, 8, 9, 10},
                           .battery_remaining_percent = 63};
const Heartbeat kHeartbeat{.type = 2, .autopilot = 3, .base_mode = 0x59, .custom_mode = 5, .system_status = 3};

// The first is a frame that other implementations test against; the others were put together from the definitions in
// common.xml by a separate program (fields sorted by size, checksum bit by bit, crc_extra from names and types).
const Bytes kHeartbeatFrame{0xfd, 0x09, 0x00, 0x00, 0xef, 0x01, 0x01, 0x00, 0x00, 0x00, 0x05,
                            0x00, 0x00, 0x00, 0x02, 0x03, 0x59, 0x03, 0x03, 0x10, 0xf0};
const Bytes kSysStatusFrame{0xfd, 0x1f, 0x00, 0x00, 0x21, 0x05, 0x01, 0x01, 0x00, 0x00, 0x03, 0x00, 0x00, 0x00, 0x02,
                            0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0xfa, 0x00, 0xb8, 0x3d, 0xd2, 0x04, 0x05, 0x00,
                            0x06, 0x00, 0x07, 0x00, 0x08, 0x00, 0x09, 0x00, 0x0a, 0x00, 0x3f, 0xdd, 0x00};
const Bytes kTargetFrame{0xfd, 0x35, 0x00, 0x00, 0xc8, 0x03, 0xbf, 0x54, 0x00, 0x00, 0x04, 0x03, 0x02,
                         0x01, 0x00, 0x00, 0xc0, 0x3f, 0x00, 0x00, 0x00, 0xc0, 0x00, 0x00, 0x40, 0x40,
                         0x00, 0x00, 0x80, 0x40, 0x00, 0x00, 0xa0, 0x40, 0x00, 0x00, 0xc0, 0x40, 0x00,
                         0x00, 0xe0, 0x40, 0x00, 0x00, 0x00, 0x41, 0x00, 0x00, 0x10, 0x41, 0x00, 0x00,
                         0x80, 0x3e, 0x00, 0x00, 0x00, 0xbf, 0x00, 0x0c, 0x07, 0x01, 0x01, 0xd0, 0xad};
const Bytes kOdometryFrame{
    0xfd, 0xe9, 0x00, 0x00, 0x11, 0x02, 0x01, 0x4b, 0x01, 0x00, 0x40, 0x22, 0x20, 0x18, 0x24, 0x0a, 0x06, 0x00, 0x00,
    0x00, 0x20, 0x41, 0x00, 0x00, 0xa0, 0xc1, 0x00, 0x00, 0x20, 0xc0, 0x00, 0x00, 0x00, 0x3f, 0x00, 0x00, 0x00, 0x3f,
    0x00, 0x00, 0x00, 0xbf, 0x00, 0x00, 0x00, 0x3f, 0x00, 0x00, 0x80, 0x3f, 0x00, 0x00, 0x00, 0x40, 0x00, 0x00, 0x40,
    0x40, 0x00, 0x00, 0x00, 0x3e, 0x00, 0x00, 0x80, 0x3e, 0x00, 0x00, 0x00, 0x3f, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
    0x80, 0x3f, 0x00, 0x00, 0x00, 0x40, 0x00, 0x00, 0x40, 0x40, 0x00, 0x00, 0x80, 0x40, 0x00, 0x00, 0xa0, 0x40, 0x00,
    0x00, 0xc0, 0x40, 0x00, 0x00, 0xe0, 0x40, 0x00, 0x00, 0x00, 0x41, 0x00, 0x00, 0x10, 0x41, 0x00, 0x00, 0x20, 0x41,
    0x00, 0x00, 0x30, 0x41, 0x00, 0x00, 0x40, 0x41, 0x00, 0x00, 0x50, 0x41, 0x00, 0x00, 0x60, 0x41, 0x00, 0x00, 0x70,
    0x41, 0x00, 0x00, 0x80, 0x41, 0x00, 0x00, 0x88, 0x41, 0x00, 0x00, 0x90, 0x41, 0x00, 0x00, 0x98, 0x41, 0x00, 0x00,
    0xa0, 0x41, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x80, 0xbf, 0x00, 0x00, 0x00, 0xc0, 0x00, 0x00, 0x40, 0xc0, 0x00,
    0x00, 0x80, 0xc0, 0x00, 0x00, 0xa0, 0xc0, 0x00, 0x00, 0xc0, 0xc0, 0x00, 0x00, 0xe0, 0xc0, 0x00, 0x00, 0x00, 0xc1,
    0x00, 0x00, 0x10, 0xc1, 0x00, 0x00, 0x20, 0xc1, 0x00, 0x00, 0x30, 0xc1, 0x00, 0x00, 0x40, 0xc1, 0x00, 0x00, 0x50,
    0xc1, 0x00, 0x00, 0x60, 0xc1, 0x00, 0x00, 0x70, 0xc1, 0x00, 0x00, 0x80, 0xc1, 0x00, 0x00, 0x88, 0xc1, 0x00, 0x00,
    0x90, 0xc1, 0x00, 0x00, 0x98, 0xc1, 0x00, 0x00, 0xa0, 0xc1, 0x01, 0x0c, 0x03, 0x00, 0xff, 0xca, 0xd5};

TEST(MavlinkCrc, GivesTheCatalogueValueOfItsAlgorithm) {
  const std::string check = "123456789";  // CRC-16/MCRF4XX in Williams' scheme: check value 0x6F91
  EXPECT_EQ(mavlink_crc(Bytes(check.begin(), check.end())), 0x6F91);
}

TEST(MavlinkFrame, HasTheBytesThatTheSpecificationSays) {
  EXPECT_EQ(mavlink_frame(kHeartbeat, {1, 1}, 239), kHeartbeatFrame);
  EXPECT_EQ(mavlink_frame(kSysStatus, {5, 1}, 33), kSysStatusFrame);
  EXPECT_EQ(mavlink_frame(target(), {3, 191}, 200), kTargetFrame);
  EXPECT_EQ(mavlink_frame(odometry(), {2, 1}, 17), kOdometryFrame);
}

TEST(MavlinkFrame, CutsTrailingZerosAndTheParserPutsThemBack) {
  Odometry still;
  still.frame_id = 0;
  still.child_frame_id = 0;
  still.time_usec = 7;
  still.q = {0, 0, 0, 0};
  const Bytes frame = mavlink_frame(still, {1, 1}, 0);
  EXPECT_EQ(frame.size(), 10u + 1u + 2u);
  MavlinkParser parser;
  const auto received = parser.on_bytes(frame);
  ASSERT_EQ(received.size(), 1u);
  EXPECT_EQ(std::get<Odometry>(received[0].message), still);
}

TEST(MavlinkParser, ReadsFramesBackHoweverTheyAreCut) {
  Bytes stream;
  std::vector<MavlinkMessage> sent;
  for (int i = 0; i < 300; ++i) {
    const std::vector<MavlinkMessage> kinds{kHeartbeat, odometry(), target()};
    sent.push_back(kinds[static_cast<std::size_t>(i % 3)]);
    const Bytes frame = mavlink_frame(sent.back(), {4, 1}, static_cast<std::uint8_t>(i));
    stream.insert(stream.end(), frame.begin(), frame.end());
  }
  for (const std::size_t cut : {1, 7, 279, 100000}) {
    MavlinkParser parser;
    std::vector<MavlinkMessage> received;
    for (std::size_t i = 0; i < stream.size(); i += cut) {
      for (const auto& r : parser.on_bytes(std::span(stream).subspan(i, std::min(cut, stream.size() - i)))) {
        EXPECT_EQ(r.from, (MavlinkAddress{4, 1}));
        received.push_back(r.message);
      }
    }
    EXPECT_EQ(received, sent) << "cut every " << cut;
    EXPECT_EQ(parser.counters().lost, 0) << "cut every " << cut;
    EXPECT_EQ(parser.counters().skipped_bytes, 0) << "cut every " << cut;
  }
}

TEST(MavlinkParser, NeverTakesAFrameWithOneByteChangedForTheOriginal) {
  for (const Bytes& frame : {kHeartbeatFrame, kTargetFrame, kOdometryFrame}) {
    for (std::size_t i = 0; i < frame.size(); ++i) {
      for (const int flip : {0x01, 0x80, 0xFF}) {
        Bytes bad = frame;
        bad[i] ^= static_cast<std::uint8_t>(flip);
        MavlinkParser parser;
        auto received = parser.on_bytes(bad);
        for (int k = 0; k < 20; ++k) {  // enough good frames to end every wait for a longer one
          for (auto& r : parser.on_bytes(kHeartbeatFrame)) received.push_back(r);
        }
        EXPECT_EQ(received.size(), 20u) << "byte " << i << " xor " << flip;
        for (const auto& r : received) EXPECT_EQ(r.message, MavlinkMessage(kHeartbeat)) << "byte " << i;
      }
    }
  }
}

TEST(MavlinkParser, FindsEachFrameBetweenGarbageAndCrashesOnNone) {
  Random random(3);
  for (int run = 0; run < 200; ++run) {
    MavlinkParser parser;
    std::int64_t found = 0;
    for (int i = 0; i < 50; ++i) {
      Bytes garbage(random() % 64);
      for (auto& byte : garbage) byte = random.uniform() < 0.1 ? 0xFD : static_cast<std::uint8_t>(random());
      found += static_cast<std::int64_t>(parser.on_bytes(garbage).size());
      found += static_cast<std::int64_t>(parser.on_bytes(kTargetFrame).size());
    }
    found += static_cast<std::int64_t>(parser.on_bytes(Bytes(300, 0)).size());
    EXPECT_EQ(found, 50) << "run " << run;
  }
}

TEST(MavlinkParser, CountsLostUnknownSignedAndIncompatibleFrames) {
  MavlinkParser parser;
  for (const int sequence : {250, 251, 251, 254, 1}) {  // one twice; lost: 252, 253; 255, 0
    EXPECT_EQ(parser.on_bytes(mavlink_frame(kHeartbeat, {9, 1}, static_cast<std::uint8_t>(sequence))).size(), 1u);
  }
  EXPECT_EQ(parser.on_bytes(mavlink_frame(kHeartbeat, {9, 2}, 77)).size(), 1u);  // another component: its own count
  EXPECT_EQ(parser.counters().lost, 4);

  EXPECT_EQ(parser.on_bytes(kHeartbeatFrame).size(), 1u);  // heard once, its sender is known
  Bytes unknown = kHeartbeatFrame;
  unknown[7] = 30;  // ATTITUDE
  EXPECT_TRUE(parser.on_bytes(unknown).empty());
  EXPECT_EQ(parser.counters().unknown, 1);

  Bytes odd = kHeartbeatFrame;
  odd[2] = 0x02;
  EXPECT_TRUE(parser.on_bytes(odd).empty());
  EXPECT_EQ(parser.counters().incompatible, 1);

  Bytes with_signature = kHeartbeatFrame;
  with_signature[2] = 0x01;
  const Bytes summed(with_signature.begin() + 1, with_signature.end() - 2);
  const Bytes crc_extra{50};
  const std::uint16_t crc = mavlink_crc(crc_extra, mavlink_crc(summed));
  with_signature[with_signature.size() - 2] = crc & 0xFF;
  with_signature.back() = static_cast<std::uint8_t>(crc >> 8);
  with_signature.insert(with_signature.end(), 13, 0xFD);
  EXPECT_EQ(parser.on_bytes(with_signature).size(), 1u);
  EXPECT_EQ(parser.on_bytes(kHeartbeatFrame).size(), 1u);
  EXPECT_EQ(parser.counters().skipped_bytes, 0);
}

TEST(MavlinkParser, IgnoresFieldsOfANewerDefinition) {
  Bytes longer = kOdometryFrame;
  longer[1] = static_cast<std::uint8_t>(longer[1] + 2);
  longer.resize(longer.size() - 2);
  longer.insert(longer.end(), {1, 2});
  Bytes summed(longer.begin() + 1, longer.end());
  summed.push_back(91);
  const std::uint16_t crc = mavlink_crc(summed);
  longer.insert(longer.end(), {static_cast<std::uint8_t>(crc & 0xFF), static_cast<std::uint8_t>(crc >> 8)});
  MavlinkParser parser;
  const auto received = parser.on_bytes(longer);
  ASSERT_EQ(received.size(), 1u);
  EXPECT_EQ(received[0].message, MavlinkMessage(odometry()));
}

}  // namespace
}  // namespace comptonaut
