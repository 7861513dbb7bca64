// SPDX-License-Identifier: BSD-3-Clause
// A whole mission through the real programs, on real LCM multicast over loopback, and its replay.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "bus/bus.h"
#include "bus/log.h"
#include "bus/test_bus.h"
#include "nodes/compare_with_truth.h"
#include "scratch.h"
#include "system/child.h"
#include "system/command.h"

namespace comptonaut {
namespace {

const std::string kBin = std::string(COMPTONAUT_BINARY_DIR) + "/bin/";

/// All messages of a log, by channel, in order.
std::map<std::string, std::vector<Bytes>> messages_in(const std::filesystem::path& log) {
  std::map<std::string, std::vector<Bytes>> messages;
  read_log(log, [&](const LogEvent& event) {
    messages[event.channel].emplace_back(event.bytes.begin(), event.bytes.end());
  });
  return messages;
}

template <class T>
T decoded(const Bytes& bytes) {
  const auto message = decode<T>(bytes);
  if (!message) throw std::runtime_error("a recorded message does not decode");
  return *message;
}

TEST(Mission, FindsItsSourcesOverMulticastAndReplaysBitForBit) {
  const auto out = scratch_folder();
  std::filesystem::remove_all(out);
  const Finished flown = run_command(fmt::format(
      "{0}/scripts/simulate.sh --build {1} --scenario {0}/tests/data/short-mission.yaml --out {2} --port {3}",
      COMPTONAUT_SOURCE_DIR, COMPTONAUT_BINARY_DIR, out.string(), free_ports(41)));
  ASSERT_EQ(flown.exit_code, 0) << flown.output;
  EXPECT_TRUE(std::filesystem::exists(out / "report.html")) << flown.output;
  const auto messages = messages_in(out / "mission.lcm");

  // Each batch of each drone arrived, once, and in the order of its numbers.
  for (int mav = 1; mav <= 3; ++mav) {
    const auto& batches = messages.at(mav_channel(mav, "MEASUREMENTS"));
    EXPECT_GE(batches.size(), 40u * 20u) << "MAV " << mav;
    for (std::size_t i = 0; i < batches.size(); ++i) {
      ASSERT_EQ(decoded<MeasurementBatch>(batches[i]).key.number, static_cast<std::int64_t>(i)) << "MAV " << mav;
    }
  }

  // The team's answer is the truth.
  const auto truth = decoded<Truth>(messages.at("SIM_TRUTH").back());
  const auto report = decoded<SourceReport>(messages.at("SOURCES").back());
  const Localisation found = compare_with_truth(report, truth.sources, truth.area);
  EXPECT_EQ(found.found_2m, 2) << "rmse " << found.rmse_m << " m";

  // Every daemon showed life.
  std::set<std::string> daemons;
  for (int mav = 0; mav <= 3; ++mav) {
    for (const Bytes& status : messages.at(mav_channel(mav, "STATUS")))
      daemons.insert(decoded<DaemonStatus>(status).daemon);
  }
  EXPECT_EQ(daemons, (std::set<std::string>{"coordinator", "detector-reader", "mapper", "pose-bridge", "simulator",
                                            "team-link"}));

  // A second coordinator that gets the recorded inputs and bases, and nothing else, says the same to the last bit.
  const std::string url = loopback_url();
  Bus bus(url);
  std::map<std::string, std::vector<Bytes>> replayed;
  bus.subscribe_raw("FOLLOWER_.*", [&](const std::string& channel, std::span<const std::uint8_t> bytes) {
    replayed[channel.substr(std::string("FOLLOWER_").size())].emplace_back(bytes.begin(), bytes.end());
  });
  std::size_t alive = 0;
  bus.subscribe_raw("MAV0_STATUS", [&](const auto&, const auto&) { ++alive; });
  Child follower(
      {kBin + "comptonaut-coordinator", "--config", (out / "coordinator.yaml").string(), "--lcm-url", url, "--follow"});
  ASSERT_TRUE(until([&] { return alive > 0; }, [&] { bus.handle(100); }));
  Child player({"/usr/bin/lcm-logplayer", "--speed", "20", "--lcm-url", url, "--regexp",
                "MAV[0-9]+_MEASUREMENTS|COORDINATOR", (out / "mission.lcm").string()});
  const std::size_t ticks = messages.at("COORDINATOR").size();
  const std::size_t tiles = messages.at("RADIATION_MAP").size();
  EXPECT_GE(ticks, 30u);  // of 40; on a busy machine the first second may be over before the last daemon is there
  EXPECT_EQ(tiles % ticks, 0u) << "the recording lacks tiles of the map";
  ASSERT_TRUE(until([&] { return replayed["RADIATION_MAP"].size() == tiles; }, [&] { bus.handle(100); },
                    std::chrono::seconds(60)))
      << replayed["COORDINATOR"].size() << " of " << ticks << " ticks";
  for (const std::string channel : {"COORDINATOR", "SOURCES", "RADIATION_MAP", "MAV1_PLAN", "MAV2_PLAN", "MAV3_PLAN"}) {
    const auto& recorded = messages.at(channel);
    ASSERT_EQ(replayed[channel].size(), recorded.size()) << channel;
    for (std::size_t i = 0; i < recorded.size(); ++i)
      ASSERT_EQ(replayed[channel][i], recorded[i]) << channel << " " << i;
  }
  follower.signal(SIGTERM);
  EXPECT_EQ(follower.wait(), 0);
}

}  // namespace
}  // namespace comptonaut
