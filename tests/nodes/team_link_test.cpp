// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/team_link.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "config/config.h"
#include "core/random.h"
#include "team/big_endian.h"
#include "team/lc02.h"

namespace comptonaut {
namespace {

using Bytes = std::vector<std::uint8_t>;

TeamLinkConfig shipped() { return load_config(COMPTONAUT_SOURCE_DIR "/config/team-link.yaml", read_team_link_config); }

/// A message that begins as a pose does: fingerprint, time.
Bytes pose_bytes(Utime utime) {
  Bytes bytes(8, 1);
  append_big_endian(bytes, utime);
  return bytes;
}

std::int64_t counter(const TeamLink& link, const std::string& name) {
  for (const Counter& c : link.counters()) {
    if (c.name == name) return c.value;
  }
  ADD_FAILURE() << "no counter " << name;
  return -1;
}

TEST(TeamLink, PassesOnWhatTeammatesNeedAndNothingElse) {
  const Bytes message = pose_bytes(1);
  struct Case {
    int mav;
    std::string channel;
    bool out, in;  // from this machine to the team; from the team (its machine 9) to this one
  };
  const std::vector<Case> cases = {
      {1, "MAV1_MEASUREMENTS", true, false},
      {1, "MAV1_POSE", true, false},
      {1, "MAV1_VEHICLE", true, false},
      {1, "MAV1_STATUS", true, false},
      {1, "MAV1_EVENTS", false, false},
      {1, "MAV1_PLAN", false, true},
      {1, "MAV2_PLAN", false, false},
      {1, "MAV2_POSE", false, true},
      {1, "MAV2_MEASUREMENTS", false, false},
      {1, "MAV12_POSE", false, true},
      {1, "COORDINATOR", false, true},
      {1, "RADIATION_MAP", false, false},
      {1, "SOURCES", false, false},
      {1, "MAV1_POSE_QUALITY", true, false},
      {1, "MAV2_POSE_QUALITY", false, false},
      {0, "MAV2_POSE_QUALITY", false, true},
      {0, "MAV1_PLAN", true, true},
      {0, "MAV3_PLAN", true, true},
      {0, "COORDINATOR", true, true},
      {0, "SOURCES", true, true},
      {0, "OPERATOR", true, true},
      {0, "MAV0_STATUS", true, true},
      {0, "RADIATION_MAP", false, true},
      {0, "MAV2_MEASUREMENTS", false, true},
      {0, "SIM_TRUTH", false, true},
  };
  for (const Case& c : cases) {
    TeamLink link(shipped(), c.mav, 1), other(shipped(), 9, 1);
    EXPECT_EQ(link.on_onboard(c.channel, message).has_value(), c.out) << "MAV " << c.mav << " sends " << c.channel;
    Bytes payload = message;
    append_trailer(payload, {.sender = 9, .boot_epoch = 5, .counter = 0});
    const auto in = link.on_team(write_lc02({.sequence = 0, .channel = c.channel, .payload = payload}));
    EXPECT_EQ(in.has_value(), c.in) << "MAV " << c.mav << " takes " << c.channel;
    if (!in) continue;
    EXPECT_EQ(in->bytes, message) << "without its trailer";
  }
}

TEST(TeamLink, DeliversOnceWhateverTheRadioRepeatsOrReorders) {
  TeamLink drone(shipped(), 1, 100), ground(shipped(), 0, 200);
  std::vector<Bytes> datagrams;
  for (std::uint8_t i = 0; i < 100; ++i) {
    const auto datagram = drone.on_onboard("MAV1_MEASUREMENTS", Bytes{i});
    ASSERT_TRUE(datagram);
    datagrams.insert(datagrams.end(), 1 + i % 3, *datagram);
  }
  Random random(5);
  for (std::size_t i = datagrams.size(); i-- > 1;) std::swap(datagrams[i], datagrams[random() % (i + 1)]);
  std::map<int, int> delivered;
  for (const Bytes& datagram : datagrams) {
    if (const auto message = ground.on_team(datagram)) ++delivered[message->bytes.at(0)];
  }
  ASSERT_EQ(delivered.size(), 100u);
  for (const auto& [message, times] : delivered) EXPECT_EQ(times, 1) << "message " << message;
  EXPECT_EQ(counter(ground, "duplicates"), static_cast<std::int64_t>(datagrams.size()) - 100);
}

TEST(TeamLink, TellsEqualMessagesApart) {
  TeamLink drone(shipped(), 1, 100), ground(shipped(), 0, 200);
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(ground.on_team(*drone.on_onboard("MAV1_STATUS", Bytes{7}))) << i;
}

TEST(TeamLink, TellsAProcessFromTheOneBeforeIt) {
  TeamLink ground(shipped(), 0, 200);
  for (const std::int64_t epoch : {100, 101}) {
    TeamLink drone(shipped(), 1, epoch);
    EXPECT_TRUE(ground.on_team(*drone.on_onboard("MAV1_STATUS", Bytes{7}))) << epoch;
  }
}

TEST(TeamLink, SendsNothingBackToWhereItCameFrom) {
  TeamLink drone(shipped(), 1, 100), ground(shipped(), 0, 200), other_ground(shipped(), 0, 300);
  const auto on_air = ground.on_onboard("MAV1_PLAN", Bytes{1, 2});
  ASSERT_TRUE(on_air);
  EXPECT_FALSE(ground.on_team(*on_air)) << "it hears itself";
  const auto onboard = drone.on_team(*on_air);
  ASSERT_TRUE(onboard);
  // A second machine with the rules of the ground would send plans on.
  TeamLinkConfig both = shipped();
  both.drone = both.ground;
  TeamLink relay(both, 2, 400);
  const auto relayed = relay.on_team(*on_air);
  ASSERT_TRUE(relayed);
  EXPECT_FALSE(relay.on_onboard(relayed->channel, relayed->bytes));
  EXPECT_EQ(counter(relay, "echoes"), 1);
  EXPECT_TRUE(relay.on_onboard("MAV1_PLAN", Bytes{1, 2})) << "the same again, but of its own";
}

TEST(TeamLink, ThinsPosesByTheirOwnTime) {
  TeamLink drone(shipped(), 1, 100);
  std::vector<Utime> sent;
  int qualities = 0;
  for (Utime utime = 1'000'000; utime < 3'000'000; utime += 20'000) {
    if (drone.on_onboard("MAV1_POSE", pose_bytes(utime))) sent.push_back(utime);
    if (drone.on_onboard("MAV1_POSE_QUALITY", pose_bytes(utime))) ++qualities;
  }
  EXPECT_EQ(qualities, 2);
  ASSERT_EQ(sent.size(), 20u);
  for (std::size_t i = 1; i < sent.size(); ++i) EXPECT_EQ(sent[i] - sent[i - 1], 100'000) << i;
  EXPECT_TRUE(drone.on_onboard("MAV1_POSE", pose_bytes(500'000))) << "the clock was set back";
}

TEST(TeamLink, KeepsOnboardWhatDoesNotFitADatagram) {
  TeamLink drone(shipped(), 1, 100), ground(shipped(), 0, 200);
  EXPECT_FALSE(drone.on_onboard("MAV1_MEASUREMENTS", Bytes(1137)));
  EXPECT_EQ(counter(drone, "oversize"), 1);
  const auto fits = drone.on_onboard("MAV1_MEASUREMENTS", Bytes(1136));
  ASSERT_TRUE(fits);
  EXPECT_TRUE(ground.on_team(*fits));
}

TEST(TeamLink, CountsAndDropsWhatIsNotOfTheTeam) {
  TeamLink drone(shipped(), 1, 100), ground(shipped(), 0, 200);
  const Bytes whole = *drone.on_onboard("MAV1_STATUS", Bytes(40, 3));
  const std::string fragment("LC03\0\0\0\1\0\0\0\5\0\0\0\0\0\0\0\1X\0", 22);
  EXPECT_FALSE(ground.on_team({}));
  EXPECT_FALSE(ground.on_team(Bytes(fragment.begin(), fragment.end())));
  EXPECT_FALSE(ground.on_team(Bytes(1500, 1)));
  EXPECT_FALSE(ground.on_team(write_lc02({.sequence = 0, .channel = "MAV1_STATUS", .payload = Bytes(40, 3)})));
  EXPECT_EQ(counter(ground, "datagrams_refused"), 4);
  Random random(9);
  for (int round = 0; round < 20'000; ++round) {
    Bytes datagram = whole;
    datagram[random() % datagram.size()] = static_cast<std::uint8_t>(random());
    datagram.resize(random() % 4 == 0 ? random() % datagram.size() : datagram.size());
    EXPECT_NO_THROW((void)ground.on_team(datagram)) << "round " << round;
  }
}

TEST(ChannelRule, RefusesWhatIsNoPattern) {
  for (const std::string pattern : {"", "mav_pose", "MAV{their}_POSE", "MAV{own}_", "MAV[0-9]+_POSE", "A B", "**"}) {
    EXPECT_THROW(ChannelRule{pattern}, std::invalid_argument) << pattern;
  }
  try {
    (void)parse_config("drone: {out: [POSE, 'MAV{all}_POSE'], in: []}", "t.yaml", read_team_link_config);
    FAIL() << "accepted";
  } catch (const ConfigError& e) {
    EXPECT_NE(std::string(e.what()).find("'MAV{all}_POSE' is not a channel"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace comptonaut
