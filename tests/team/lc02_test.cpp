// SPDX-License-Identifier: BSD-3-Clause
#include "team/lc02.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "core/random.h"

namespace comptonaut {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes bytes(const std::string& text) { return {text.begin(), text.end()}; }

TEST(Lc02, IsReadAsItIsWritten) {
  const Bytes payload = {1, 0, 255};
  const Bytes datagram = write_lc02({.sequence = 0x01020304, .channel = "MAV1_POSE", .payload = payload});
  EXPECT_EQ(datagram, bytes(std::string("LC02\x01\x02\x03\x04MAV1_POSE\0\x01\0\xff", 21)));
  const auto message = read_lc02(datagram);
  ASSERT_TRUE(message);
  EXPECT_EQ(message->sequence, 0x01020304u);
  EXPECT_EQ(message->channel, "MAV1_POSE");
  EXPECT_EQ(Bytes(message->payload.begin(), message->payload.end()), payload);
}

TEST(Lc02, RefusesWhatIsNotAShortMessage) {
  const std::string header("LC02\0\0\0\1", 8);
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"nothing", ""},
      {"a cut header", header.substr(0, 7)},
      {"no channel's end", header + "MAV1_POSE"},
      {"an empty channel", header + std::string(1, '\0') + "x"},
      {"a channel of 64 characters", header + std::string(64, 'A') + std::string(1, '\0')},
      {"a blank in the channel", header + std::string("A B\0", 4)},
      {"a channel that is not ASCII", header + std::string("A\xc3\xa4\0", 4)},
      {"a fragment", std::string("LC03\0\0\0\1\0\0\0\5\0\0\0\0\0\0\0\1X\0", 22)},
      {"another protocol", std::string("LC01\0\0\0\1X\0", 10)},
      {"more than a datagram", header + std::string("X\0", 2) + std::string(1426, 'x')},
  };
  for (const auto& [what, text] : cases) EXPECT_FALSE(read_lc02(bytes(text))) << what;
  EXPECT_TRUE(read_lc02(bytes(header + std::string(63, 'A') + std::string(1, '\0'))));
  EXPECT_TRUE(read_lc02(bytes(header + std::string("X\0", 2) + std::string(1425, 'x'))));
}

TEST(Lc02, WritesNothingThatItWouldRefuse) {
  const Bytes large(1426);
  EXPECT_THROW((void)write_lc02({.sequence = 0, .channel = "X", .payload = large}), std::invalid_argument);
  EXPECT_THROW((void)write_lc02({.sequence = 0, .channel = "", .payload = {}}), std::invalid_argument);
  EXPECT_THROW((void)write_lc02({.sequence = 0, .channel = "A B", .payload = {}}), std::invalid_argument);
}

TEST(Lc02, SurvivesRandomDatagrams) {
  Random random(11);
  const Bytes payload(40, 7);
  const Bytes whole = write_lc02({.sequence = 5, .channel = "MAV1_POSE", .payload = payload});
  for (int round = 0; round < 50'000; ++round) {
    Bytes datagram = whole;
    for (int i = 0; i < 3; ++i) datagram[random() % datagram.size()] = static_cast<std::uint8_t>(random());
    datagram.resize(random() % (2 * whole.size()));
    const auto message = read_lc02(datagram);
    if (!message) continue;
    const Bytes again = write_lc02(*message);
    EXPECT_EQ(again, datagram) << "round " << round;
  }
}

}  // namespace
}  // namespace comptonaut
