// SPDX-License-Identifier: BSD-3-Clause
// Whole missions in one process: simulated world, all nodes, messages as on the bus.
#include "sim/mission.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>

#include "scratch.h"
#include "sim/campaign.h"
#include "sim/campaign_csv.h"
#include "sim/campaign_merge.h"
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

std::vector<CampaignTeam> two_teams() {
  std::vector<CampaignTeam> teams;
  for (const std::string strategy : {"werner2024", "zigzag"}) {
    teams.push_back(
        {.names = {.scenario = "small", .strategy = strategy, .estimator = "joint"}, .setup = small_setup(strategy)});
  }
  return teams;
}

TEST(Campaign, GivesTheSameBytesAtEveryRunAndAnyNumberOfJobs) {
  const auto teams = two_teams();
  const auto run = [&](int jobs) {
    const auto result =
        run_campaign(teams, {.first = 1, .last = 2}, {}, jobs, [](const CampaignProgress&) { return true; });
    EXPECT_TRUE(result.missing.empty());
    return campaign_csv(result.parts) + per_source_csv(result.parts);
  };
  const std::string first = run(1);
  EXPECT_EQ(first, run(1));
  EXPECT_EQ(first, run(2));
}

TEST(Campaign, OfShardsMergesToTheBytesOfOneInOneGo) {
  const auto teams = two_teams();
  constexpr SeedRange kSeeds{.first = 1, .last = 2};
  const auto fly = [&](Shard shard) {
    return run_campaign(teams, kSeeds, shard, 1, [](const CampaignProgress&) { return true; });
  };
  std::vector<ShardText> shards;
  for (const Shard shard : {Shard{3, 3}, Shard{1, 3}, Shard{2, 3}}) {
    shards.push_back({.name = "runs", .text = shard_text(facts_of(teams, kSeeds), shard, fly(shard))});
  }
  const auto merged = merge_shards(shards).parts, whole = fly({}).parts;
  EXPECT_EQ(campaign_csv(merged), campaign_csv(whole));
  EXPECT_EQ(per_source_csv(merged), per_source_csv(whole));
}

/// A scenario of the same name that is not the same, as when one machine of several has another copy of the file.
TEST(Campaign, IsAnotherOneWithAnotherFile) {
  const auto line = [](const std::string& horizon_s) {
    const auto file = scratch_file("s.yaml", "name: s\nhorizon_s: " + horizon_s +
                                                 "\narea: {x_min_m: 0, x_max_m: 20, y_min_m: 0, y_max_m: 20}\n"
                                                 "mavs: {count: 2}\nsources: [{x_m: 1, y_m: 1, activity_Bq: 4.0e9}]\n");
    const MissionSetup setup = load_setup({.scenario = file, .coordinator = kConfig / "coordinator.yaml"});
    return facts_of(std::vector<CampaignTeam>{{.names = {"s", "none", "joint"}, .setup = setup}}, {1, 2}).line;
  };
  EXPECT_TRUE(line("20").starts_with("s, seeds 1:2, none joint, lane 2 m, setup ")) << line("20");
  EXPECT_EQ(line("20"), line("20"));
  EXPECT_NE(line("20"), line("30"));
}

TEST(Campaign, OneFailingMissionLeavesTheOthersWhole) {
  auto teams = two_teams();
  teams[0].setup.coordinator.search.strategy = "luck";
  CampaignProgress last;
  const auto result = run_campaign(teams, {.first = 1, .last = 1}, {}, 2, [&](const CampaignProgress& progress) {
    EXPECT_GE(progress.missions_done, last.missions_done);
    last = progress;
    return true;
  });
  EXPECT_EQ(last.missions, 2u);
  EXPECT_EQ(last.missions_done, 2u) << "a failed mission is done, and the end is told";
  EXPECT_TRUE(result.parts[0].missions.empty());
  ASSERT_EQ(result.parts[1].missions.size(), 1u);
  EXPECT_EQ(result.parts[1].missions[0].steps.size(), 20u);
  ASSERT_EQ(result.missing.size(), 1u);
  EXPECT_NE(result.missing[0].find("werner2024, joint, seed 1: "), std::string::npos) << result.missing[0];
  EXPECT_NE(result.missing[0].find("luck"), std::string::npos) << result.missing[0];
}

TEST(Campaign, StoppedNamesEachMissionThatIsMissing) {
  auto teams = two_teams();
  for (CampaignTeam& team : teams) team.setup.scenario.horizon_s = 1e6;
  const auto result =
      run_campaign(teams, {.first = 1, .last = 2}, {}, 1, [](const CampaignProgress&) { return false; });
  EXPECT_TRUE(result.parts[0].missions.empty());
  ASSERT_EQ(result.missing.size(), 4u);
  EXPECT_NE(result.missing[0].find("seed 1: stopped in flight"), std::string::npos) << result.missing[0];
  EXPECT_NE(result.missing[3].find("zigzag, joint, seed 2: not flown"), std::string::npos) << result.missing[3];
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
    EXPECT_EQ(result.outside_s, 0.0) << strategy;
    EXPECT_EQ(result.at_home, 2) << strategy;
    EXPECT_GT(result.events.singles, 10 * result.events.pairs) << strategy;
    EXPECT_GT(result.events.pairs, 20) << strategy;
  }
}

// Seeds of which one MAV stood before another one that hung at its home until the mission was over.
TEST(Mission, BringsEveryMavHomePastThoseThatAreThereAlready) {
  for (const std::uint64_t seed : {4, 18}) {
    const auto file =
        scratch_file("s.yaml",
                     "name: s\nhorizon_s: 40\narea: {x_min_m: 0, x_max_m: 50, y_min_m: 0, y_max_m: 50}\n"
                     "mavs: {count: 3}\nmismatch: {stray_share: 0.05}\n"
                     "sources_by_seed: {activities_Bq: [2.0e9, 2.0e9, 2.0e9, 2.0e9, 2.0e9], distance_min_m: 8}\n");
    MissionSetup setup = load_setup({.scenario = file, .coordinator = kConfig / "coordinator.yaml"});
    setup.coordinator.estimator = "mlem";
    std::atomic<std::int64_t> seconds_done = 0;
    const MissionResult result = fly_mission(setup, seed, seconds_done);
    EXPECT_EQ(result.at_home, 3) << "seed " << seed;
    EXPECT_GT(result.distance_min_m, 2.0) << "seed " << seed;
    EXPECT_EQ(result.outside_s, 0.0) << "seed " << seed;
  }
}

TEST(Mission, BringsEveryMavHomeWhileItsBatteryLasts) {
  const auto file =
      scratch_file("battery.yaml",
                   "name: battery\nhorizon_s: 60\narea: {x_min_m: 0, x_max_m: 50, y_min_m: 0, y_max_m: 50}\n"
                   "mavs: {count: 3, endurance_s: 50}\nsources: [{x_m: 12.3, y_m: 11.1, activity_Bq: 4.0e9}]\n");
  MissionSetup setup = load_setup({.scenario = file, .coordinator = kConfig / "coordinator.yaml"});
  setup.coordinator.search.strategy = "zigzag";
  std::atomic<std::int64_t> seconds_done = 0;
  const MissionResult result = fly_mission(setup, 1, seconds_done);
  const auto down_to_reserve = static_cast<std::size_t>(0.8 * 50.0 / seconds(kTrackPeriod_us));
  for (const std::vector<Eigen::Vector3f>& track : result.tracks) {
    EXPECT_LT((track[down_to_reserve] - track.front()).norm(), setup.coordinator.search.reach_m);
    EXPECT_GT((track[down_to_reserve / 3] - track.front()).norm(), 10.0F) << "it was away";
  }
}

TEST(Mission, WithoutAStrategyNobodyMoves) {
  std::atomic<std::int64_t> seconds_done = 0;
  const MissionResult result = fly_mission(small_setup("none"), 1, seconds_done);
  EXPECT_NEAR(result.distance_min_m, 4.0, 0.2);
  EXPECT_EQ(result.at_home, 2);
}

TEST(Mission, TimeOutsideTheFenceIsCounted) {
  MissionSetup setup = small_setup("none");
  setup.coordinator.search.route.fence.excluded.push_back(polygon_of(setup.scenario.area));
  std::atomic<std::int64_t> seconds_done = 0;
  EXPECT_NEAR(fly_mission(setup, 1, seconds_done).outside_s, 2 * 20.0, 0.7);
}

TEST(LoadSetup, RefusesACoordinatorWithATerrainOfItsOwn) {
  constexpr auto kAnew = std::filesystem::copy_options::overwrite_existing | std::filesystem::copy_options::recursive;
  for (const std::string file : {"detector-reader.yaml", "mapper.yaml", "pose-bridge.yaml"}) {
    std::filesystem::copy(kConfig / file, scratch_file(file), kAnew);
  }
  std::filesystem::copy(kConfig / "nuclides", scratch_file("nuclides"), kAnew);
  (void)scratch_file("hills.txt", "0 1\n1 2\n");
  for (const auto& [key, value] :
       {std::pair("heightmap", "{file: hills.txt, metres_per_pixel: 1}"), std::pair("octomap", "hills.bt")}) {
    const auto file =
        scratch_file("coordinator.yaml", fmt::format("mission: 1\nresponse_table: t.csv\n{}: {}\n", key, value));
    std::string said = "accepted";
    try {
      (void)load_setup({.scenario = kConfig / "scenarios/wide.yaml", .coordinator = file});
    } catch (const std::runtime_error& error) {
      said = error.what();
    }
    EXPECT_EQ(said,
              fmt::format("{}: {}: a campaign flies in the scenario's world, must be left out", file.string(), key));
  }
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
