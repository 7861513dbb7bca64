// SPDX-License-Identifier: BSD-3-Clause
// Whole missions in one process: simulated world, all nodes, messages as on the bus.
#include "sim/mission.h"

#include <gtest/gtest.h>

#include <fstream>

#include "scratch.h"
#include "sim/campaign.h"
#include "sim/campaign_csv.h"
#include "sim/load_setup.h"

namespace comptonaut {
namespace {

const std::filesystem::path kConfig = std::filesystem::path(COMPTONAUT_SOURCE_DIR) / "config";

/// Two MAVs, one strong source within a small field.
MissionSetup small_setup(const std::string& strategy) {
  const auto file =
      scratch_file("small.yaml",
                   "name: small\nhorizon_s: 20\narea: {x_min_m: 0, x_max_m: 20, y_min_m: 0, y_max_m: 20}\n"
                   "mavs: {count: 2}\nsources: [{x_m: 12.3, y_m: 11.1, activity_Bq: 4.0e9}]\n");
  MissionSetup setup = load_setup({.scenario = file, .coordinator = kConfig / "coordinator.yaml"});
  setup.coordinator.search.strategy = strategy;
  return setup;
}

TEST(Campaign, GivesTheSameBytesAtEveryRunAndAnyNumberOfJobs) {
  const MissionSetup setup = small_setup("werner2024");
  const CampaignNames names{.scenario = "small", .strategy = "werner2024", .estimator = "mlem"};
  const auto run = [&](int jobs) {
    const auto missions = run_campaign(setup, {.first = 1, .last = 3}, jobs, [](double) {});
    return campaign_csv(names, missions) + per_source_csv(missions);
  };
  const std::string first = run(1);
  EXPECT_EQ(first, run(1));
  EXPECT_EQ(first, run(2));
}

TEST(Mission, FindsAStrongSourceAndKeepsTheDronesApart) {
  for (const std::string strategy : {"werner2024", "zigzag"}) {
    std::atomic<std::int64_t> seconds_done = 0;
    const MissionResult result = fly_mission(small_setup(strategy), 1, seconds_done);
    ASSERT_EQ(result.steps.size(), 20u) << strategy;
    EXPECT_EQ(seconds_done, 20) << strategy;
    EXPECT_EQ(result.steps.front().t_s, 1.0) << strategy;
    EXPECT_EQ(result.steps.back().localisation.found_2m, 1) << strategy;
    EXPECT_GT(result.distance_min_m, 1.5) << strategy;
    EXPECT_GT(result.events.singles, 10 * result.events.pairs) << strategy;
    EXPECT_GT(result.events.pairs, 20) << strategy;
  }
}

TEST(Mission, WithoutAStrategyNobodyMoves) {
  std::atomic<std::int64_t> seconds_done = 0;
  const MissionResult result = fly_mission(small_setup("none"), 1, seconds_done);
  EXPECT_NEAR(result.distance_min_m, 4.0, 0.2);
}

TEST(Seeds, AreARangeOrOneNumber) {
  EXPECT_EQ(parse_seeds("3:7").first, 3u);
  EXPECT_EQ(parse_seeds("3:7").size(), 5u);
  EXPECT_EQ(parse_seeds("4").last, 4u);
  EXPECT_EQ(parse_seeds("1:1000000").size(), 1'000'000u);
  for (const std::string wrong : {"", ":", "1:", ":3", "7:3", "a:b", "1:2:3", "-1:3", "0:1000000", " 1"}) {
    EXPECT_THROW((void)parse_seeds(wrong), std::invalid_argument) << "'" << wrong << "'";
  }
}

}  // namespace
}  // namespace comptonaut
