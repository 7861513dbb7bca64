// SPDX-License-Identifier: BSD-3-Clause
// A wall stands across the way that the team's map does not hold.
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace comptonaut
