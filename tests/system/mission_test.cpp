// SPDX-License-Identifier: BSD-3-Clause
// A whole mission through the real programs, on real LCM multicast over loopback, and its replay.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
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
using Messages = std::map<std::string, std::vector<Bytes>>;

Messages messages_in(const std::filesystem::path& log) {
  Messages messages;
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

/// Through scripts/simulate.sh; the messages of its log.
Messages fly(const std::string& scenario, const std::filesystem::path& out) {
  std::filesystem::remove_all(out);
  const Finished flown =
      run_command(fmt::format("{0}/scripts/simulate.sh --build {1} --scenario {0}/tests/data/{2} --out {3} --port {4}",
                              COMPTONAUT_SOURCE_DIR, COMPTONAUT_BINARY_DIR, scenario, out.string(), free_ports(41)));
  if (flown.exit_code != 0) throw std::runtime_error(flown.output);
  EXPECT_TRUE(std::filesystem::exists(out / "report.html")) << flown.output;
  return messages_in(out / "mission.lcm");
}

/// A second coordinator that gets the recorded inputs and bases, and nothing else, says the same to the last bit.
void expect_same_in_replay(const std::filesystem::path& out, const Messages& messages, int mavs) {
  const std::string url = loopback_url();
  Bus bus(url);
  Messages replayed;
  bus.subscribe_raw("FOLLOWER_.*", [&](const std::string& channel, std::span<const std::uint8_t> bytes) {
    replayed[channel.substr(std::string("FOLLOWER_").size())].emplace_back(bytes.begin(), bytes.end());
  });
  std::size_t alive = 0;
  bus.subscribe_raw("MAV0_STATUS", [&](const auto&, const auto&) { ++alive; });
  Child follower(
      {kBin + "comptonaut-coordinator", "--config", (out / "coordinator.yaml").string(), "--lcm-url", url, "--follow"});
  ASSERT_TRUE(until([&] { return alive > 0; }, [&] { bus.handle(100); }));
  Child player({"/usr/bin/lcm-logplayer", "--speed", "20", "--lcm-url", url, "--regexp",
                "MAV[0-9]+_(MEASUREMENTS|TERRAIN)|COORDINATOR", (out / "mission.lcm").string()});
  const std::size_t ticks = messages.at("COORDINATOR").size();
  const std::size_t tiles = messages.at("RADIATION_MAP").size();
  ASSERT_TRUE(until([&] { return replayed["RADIATION_MAP"].size() == tiles; }, [&] { bus.handle(100); },
                    std::chrono::seconds(60)))
      << replayed["COORDINATOR"].size() << " of " << ticks << " ticks";
  std::vector<std::string> channels = {"COORDINATOR", "SOURCES", "RADIATION_MAP"};
  for (int mav = 1; mav <= mavs; ++mav) channels.push_back(mav_channel(mav, "PLAN"));
  for (const std::string& channel : channels) {
    const auto& recorded = messages.at(channel);
    ASSERT_EQ(replayed[channel].size(), recorded.size()) << channel;
    for (std::size_t i = 0; i < recorded.size(); ++i)
      ASSERT_EQ(replayed[channel][i], recorded[i]) << channel << " " << i;
  }
  follower.signal(SIGTERM);
  EXPECT_EQ(follower.wait(), 0);
}

TEST(Mission, FindsItsSourcesOverMulticastAndReplaysBitForBit) {
  const auto out = scratch_folder();
  const Messages messages = fly("short-mission.yaml", out);
  const std::size_t ticks = messages.at("COORDINATOR").size();
  EXPECT_GE(ticks, 30u);  // of 40; on a busy machine the last daemon may come late
  EXPECT_EQ(messages.at("RADIATION_MAP").size() % ticks, 0u) << "the recording lacks tiles of the map";

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

  expect_same_in_replay(out, messages, 3);
}

TEST(Mission, FliesByAWallThatItsMapDoesNotHold) {
  const auto out = scratch_folder();
  const Messages messages = fly("unknown-wall.yaml", out);
  std::set<VoxelKey> seen;
  for (int mav = 1; mav <= 2; ++mav) {
    for (const Bytes& bytes : messages.at(mav_channel(mav, "TERRAIN"))) {
      for (const auto& [voxel, occupancy] : decoded<TerrainTile>(bytes).voxels) {
        if (occupancy == Occupancy::kOccupied) seen.insert(voxel);
      }
    }
  }
  const auto in_wall = [](const VoxelKey& voxel) { return voxel.x >= 35 && voxel.x <= 37; };
  EXPECT_GT(std::ranges::count_if(seen, in_wall), 0.95 * static_cast<double>(seen.size()))
      << "attitudes are 1 degree off";
  EXPECT_GT(seen.size(), 100u);
  std::int64_t changed = 0;
  for (const Bytes& bytes : messages.at("MAV0_STATUS")) {
    for (const Counter& counter : decoded<DaemonStatus>(bytes).counters) {
      if (counter.name == "voxels_changed") changed = std::max(changed, counter.value);
    }
  }
  EXPECT_GE(changed, static_cast<std::int64_t>(seen.size()) / 2) << "the coordinator took what the mappers found";
  expect_same_in_replay(out, messages, 2);
}

}  // namespace
}  // namespace comptonaut
