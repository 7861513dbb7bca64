// SPDX-License-Identifier: BSD-3-Clause
// Missions between obstacles, also round a wall that the team's map does not hold.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <ranges>

#include "scratch.h"
#include "sim/load_setup.h"

namespace comptonaut {
namespace {

MissionSetup walled(const std::string& more) {
  const std::string text =
      "name: walled\nhorizon_s: 60\narea: {x_min_m: 0, x_max_m: 36, y_min_m: 0, y_max_m: 20}\n"
      "world: {boxes: [{x_min_m: 18, x_max_m: 18.5, y_min_m: -8, y_max_m: 24, z_max_m: 5}]}\n"
      "mavs: {count: 2, speed_max_m_s: 4}\nsources: [{x_m: 31.2, y_m: 11.1, activity_Bq: 4.0e9}]\n";
  const auto file = scratch_file("walled.yaml", text + more);
  const std::filesystem::path config = std::filesystem::path(COMPTONAUT_SOURCE_DIR) / "config";
  return load_setup({.scenario = file, .coordinator = config / "coordinator.yaml"});
}

MissionResult flown(const std::string& more) {
  std::atomic<std::int64_t> seconds_done = 0;
  return fly_mission(walled(more), 1, seconds_done, {});
}

TEST(UnknownWall, IsFlownIntoWithoutRangeSensors) { EXPECT_GT(flown("known_world: {flat: true}\n").collisions, 0); }

TEST(UnknownWall, IsFlownRoundWithThemAndTheSourceBehindItIsFound) {
  const MissionResult result = flown("known_world: {flat: true}\nrange_sensor: {range_m: 20, rays: 2000}\n");
  EXPECT_EQ(result.collisions, 0);
  EXPECT_TRUE(time_to_success_s(result.steps));
  EXPECT_EQ(result.at_home, 2);
}

/// The shipped town as it is, but for how long it is searched.
TEST(Town, IsFlownThroughWithoutACollisionAndEveryoneComesHome) {
  const std::filesystem::path config = std::filesystem::path(COMPTONAUT_SOURCE_DIR) / "config";
  std::ifstream shipped(config / "scenarios/town.yaml");
  std::string text{std::istreambuf_iterator<char>(shipped), {}};
  const std::string whole = "horizon_s: 600";
  ASSERT_NE(text.find(whole), std::string::npos);
  text.replace(text.find(whole), whole.size(), "horizon_s: 40");
  const MissionSetup setup =
      load_setup({.scenario = scratch_file("town.yaml", text), .coordinator = config / "coordinator.yaml"});
  std::atomic<std::int64_t> seconds_done = 0;
  const MissionResult result = fly_mission(setup, 1, seconds_done);
  EXPECT_EQ(result.collisions, 0);
  EXPECT_EQ(result.outside_s, 0.0);
  EXPECT_EQ(result.at_home, 3);
  EXPECT_GE(result.distance_min_m, setup.pose_bridge.pilot.separation.distance_min_m);
  for (const std::vector<Eigen::Vector3f>& track : result.tracks) {
    const auto away_m = [&](const Eigen::Vector3f& p_W) { return (p_W - track.front()).norm(); };
    EXPECT_GT(std::ranges::max(track | std::views::transform(away_m)), 15.0F) << "it searched nothing";
  }
}

}  // namespace
}  // namespace comptonaut
