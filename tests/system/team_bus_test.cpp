// SPDX-License-Identifier: BSD-3-Clause
// Two real team-links in processes of their own, each on an onboard bus of its own, over a team bus that repeats.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "bus/bus.h"
#include "bus/samples.h"
#include "bus/test_bus.h"
#include "system/child.h"
#include "team/lc02.h"
#include "team/multicast_socket.h"

namespace comptonaut {
namespace {

const std::string kTeamLink = COMPTONAUT_BINARY_DIR "/bin/comptonaut-team-link";
const std::string kConfig = COMPTONAUT_SOURCE_DIR "/config/team-link.yaml";
constexpr int kMessages = 200;

class TeamBus : public testing::Test {
 protected:
  std::string team_url_ = "udpm://239.255.77.1:" + std::to_string(free_udp_port()) + "?ttl=0";
  std::string drone_url_ = loopback_url(), ground_url_ = loopback_url();
  Bus drone_bus_{drone_url_}, ground_bus_{ground_url_};
  MulticastSocket air_{parse_multicast_url(team_url_)};
  Child drone_link_{command("1", drone_url_)}, ground_link_{command("0", ground_url_)};
  std::map<std::int64_t, int> at_ground_, at_drone_;  // how often each number was heard
  bool hears_drone_ = false;

  [[nodiscard]] std::vector<std::string> command(const std::string& mav, const std::string& url) const {
    return {kTeamLink, "--config",   kConfig,   "--mav",        mav, "--lcm-url",
            url,       "--team-url", team_url_, "--time-scale", "20"};
  }
  void SetUp() override {
    ground_bus_.subscribe<DaemonStatus>("MAV1_STATUS", [this](const auto&, const auto&) { hears_drone_ = true; });
    ground_bus_.subscribe<MeasurementBatch>(
        "MAV1_MEASUREMENTS", [this](const auto&, const MeasurementBatch& batch) { ++at_ground_[batch.key.number]; });
    drone_bus_.subscribe<Plan>("MAV1_PLAN", [this](const auto&, const Plan& plan) { ++at_drone_[plan.number]; });
    ASSERT_TRUE(until([this] { return hears_drone_; }, [this] { turn(); })) << "the links did not find each other";
  }
  /// Handles what came, and repeats on the air whatever is there.
  void turn() {
    for (int i = 0; i < 100; ++i) {
      const auto datagram = air_.receive();
      if (!datagram) break;
      const bool again = repeats_.insert(*datagram).second;
      EXPECT_TRUE(!again || air_.send(*datagram));
    }
    while (drone_bus_.handle(0)) {
    }
    ground_bus_.handle(5);
  }
  void expect_each_once(const std::map<std::int64_t, int>& heard) {
    EXPECT_EQ(heard.size(), static_cast<std::size_t>(kMessages));
    for (const auto& [number, times] : heard) EXPECT_EQ(times, 1) << "number " << number;
  }

 private:
  struct Shorter {
    bool operator()(const Bytes& a, const Bytes& b) const {
      return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
    }
  };
  std::set<Bytes, Shorter> repeats_;
};

TEST_F(TeamBus, DeliversEachMessageOnceBothWays) {
  auto batch = sample<MeasurementBatch>();
  auto plan = sample<Plan>();
  for (int i = 0; i < kMessages; ++i) {
    batch.key.number = plan.number = i;
    drone_bus_.publish("MAV1_MEASUREMENTS", batch);
    ground_bus_.publish("MAV1_PLAN", plan);
    turn();
  }
  EXPECT_TRUE(
      until([this] { return at_ground_.size() >= kMessages && at_drone_.size() >= kMessages; }, [this] { turn(); }));
  for (int i = 0; i < 40; ++i) turn();  // repeated ones that should not come
  expect_each_once(at_ground_);
  expect_each_once(at_drone_);
  drone_link_.signal(SIGTERM);
  ground_link_.signal(SIGTERM);
  EXPECT_EQ(drone_link_.wait(), 0);
  EXPECT_EQ(ground_link_.wait(), 0);
}

TEST_F(TeamBus, SurvivesWhatOthersSendOnTheAir) {
  const std::string fragment("LC03\0\0\0\1\x7f\xff\xff\xff\0\0\0\0\0\0\xff\xff", 20);
  for (const Bytes& garbage : {Bytes{}, Bytes(5, 'L'), Bytes(fragment.begin(), fragment.end()), Bytes(1400, 0xff),
                               write_lc02({.sequence = 1, .channel = "MAV1_MEASUREMENTS", .payload = Bytes(100, 1)})}) {
    EXPECT_TRUE(air_.send(garbage));
  }
  auto batch = sample<MeasurementBatch>();
  for (int i = 0; i < kMessages; ++i) {
    batch.key.number = i;
    drone_bus_.publish("MAV1_MEASUREMENTS", batch);
    turn();
  }
  EXPECT_TRUE(until([this] { return at_ground_.size() >= kMessages; }, [this] { turn(); }));
  expect_each_once(at_ground_);
}

// LCM's own tools, on a machine that trusts its radio, read the team's messages: the trailer is none of their business.
TEST_F(TeamBus, CanBeReadWithLcm) {
  Bus lcm(team_url_);
  int batches = 0;
  lcm.subscribe<MeasurementBatch>("MAV1_MEASUREMENTS", [&](const auto&, const auto&) { ++batches; });
  drone_bus_.publish("MAV1_MEASUREMENTS", sample<MeasurementBatch>());
  EXPECT_TRUE(until([&] { return batches > 0; }, [&] { lcm.handle(50); }));
}

}  // namespace
}  // namespace comptonaut
