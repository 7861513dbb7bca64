// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sim/campaign_csv.h"
#include "sim/campaign_figures.h"
#include "sim/campaign_merge.h"
#include "sim/campaign_summary.h"

namespace comptonaut {
namespace {

const CampaignNames kNames{.scenario = "a", .strategy = "zigzag", .estimator = "mlem"};

/// Two sources, found from `found_s` on, with an error of 100 m / t.
MissionResult mission(std::uint64_t seed, int horizon_s, int found_s) {
  MissionResult result{.seed = seed, .events = {.singles = 900, .pairs = 40, .others = 60}, .distance_min_m = 3.5};
  for (int t_s = 1; t_s <= horizon_s; ++t_s) {
    Judgement step{.t_s = static_cast<double>(t_s), .coverage = 0.25};
    step.localisation.rmse_nearest_m = step.localisation.rmse_m = 100.0 / t_s;
    step.localisation.nearest_m = {1.0, 2.0};
    step.localisation.reported = 2;
    if (t_s >= found_s) step.localisation.found_2m = 2;
    result.steps.push_back(step);
  }
  result.cpu_s = 2.0;
  return result;
}

TEST(CampaignCsv, HasARowPerSeedAndSecondAndEmptyFieldsWhereNothingIsDefined) {
  std::vector<CampaignPart> parts = {{kNames, {mission(4, 2, 9), mission(5, 2, 9)}}};
  auto& missions = parts[0].missions;
  missions[1].steps[1].localisation.activity_error_rel = 0.125;
  missions[1].steps[1].crb_m = 0.031;
  EXPECT_EQ(campaign_csv(parts),
            "scenario,strategy,estimator,seed,t_s,rmse_nearest_m,rmse_m,found_2m,found_0.5m,reported,false,coverage,"
            "activity_error_rel,crb_m\n"
            "a,zigzag,mlem,4,1,100.0000,100.0000,0,0,2,0,0.2500,,\n"
            "a,zigzag,mlem,4,2,50.0000,50.0000,0,0,2,0,0.2500,,\n"
            "a,zigzag,mlem,5,1,100.0000,100.0000,0,0,2,0,0.2500,,\n"
            "a,zigzag,mlem,5,2,50.0000,50.0000,0,0,2,0,0.2500,0.1250,0.0310\n");
}

TEST(PerSourceCsv, HasARowPerSource) {
  std::vector<CampaignPart> parts = {{kNames, {mission(4, 1, 9)}}};
  auto& missions = parts[0].missions;
  missions[0].steps[0].errors = {{},
                                 {.x_m = 0.1, .y_m = -2.0, .x_sigma_m = 0.2, .y_sigma_m = 0.3, .activity_rel = 0.5}};
  EXPECT_EQ(per_source_csv(parts),
            "seed,t_s,source,error_m,x_error_m,y_error_m,x_sigma_m,y_sigma_m,activity_error_rel,activity_sigma_rel\n"
            "4,1,1,1.0000,,,,,,\n"
            "4,1,2,2.0000,0.1000,-2.0000,0.2000,0.3000,0.5000,\n");
}

TEST(PerSourceCsv, NamesTheConfigurationWhereThereAreSeveral) {
  const std::vector<CampaignPart> parts = {{kNames, {mission(4, 1, 9)}}, {{"a", "none", "joint"}, {}}};
  const std::string text = per_source_csv(parts);
  EXPECT_TRUE(text.starts_with("scenario,strategy,estimator,seed,t_s,source,")) << text;
  EXPECT_NE(text.find("\na,zigzag,mlem,4,1,1,1.0000,"), std::string::npos) << text;
}

TEST(CampaignSummary, TellsTimesErrorsEventsAndSpeed) {
  const std::string text = campaign_summary({kNames, {mission(1, 120, 40), mission(2, 120, 50), mission(3, 120, 200)}});
  for (const std::string wanted :
       {"time to success: median 50 s, worst more than 120 s (1 of 3 runs never)", "1.67     0.83        -        -",
        "90.0 % singles, 4.0 % pairs, 6.0 % others of 1000 a mission", "3.50 m", "60.0 x real time"}) {
    EXPECT_NE(text.find(wanted), std::string::npos) << wanted << " is not in\n" << text;
  }
}

TEST(CampaignComparison, HasALinePerConfigurationAlsoWhereNothingWasFlown) {
  const std::vector<CampaignPart> parts = {{kNames, {mission(1, 120, 40), mission(2, 120, 50)}},
                                           {{"a", "none", "joint"}, {}}};
  const std::string text = campaign_comparison(parts);
  EXPECT_NE(text.find("zigzag        mlem                  45 s            50 s      0     0.83    2.00   0.00        "
                      "3.50     2\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("none          joint     no mission came to its end\n"), std::string::npos) << text;
}

TEST(CampaignFigures, AddUpWhatHappensInFlightAndTakeTheMeanOfTheEnds) {
  std::vector<MissionResult> missions = {mission(1, 100, 40), mission(2, 100, 50), mission(3, 100, 200)};
  for (MissionResult& one : missions) one.tracks.resize(2);
  missions[0].collisions = 2;
  missions[2].collisions = 1;
  missions[1].outside_s = 0.5;
  missions[2].outside_s = 0.25;
  missions[0].at_home = missions[1].at_home = 2;
  missions[1].distance_min_m = 1.5;
  missions[2].steps.back().localisation.false_reports = 3;
  const CampaignFigures figures = figures_of(missions);
  EXPECT_EQ(figures.success_s, (std::vector<double>{40, 50, std::numeric_limits<double>::infinity()}));
  EXPECT_EQ(figures.success_median_s, 50.0);
  EXPECT_EQ(figures.never, 1);
  EXPECT_NEAR(figures.rmse_mean_m, 1.0, 1e-12);
  EXPECT_NEAR(figures.found_mean, 4.0 / 3.0, 1e-12);
  EXPECT_NEAR(figures.false_mean, 1.0, 1e-12);
  EXPECT_EQ(figures.distance_min_m, 1.5);
  EXPECT_EQ(figures.collisions, 3);
  EXPECT_EQ(figures.outside_s, 0.75);
  EXPECT_EQ(figures.at_home, 4);
  EXPECT_EQ(figures.mavs, 6u);
  const std::string text = campaign_summary({kNames, missions});
  EXPECT_NE(
      text.find("between MAVs: 1.50 m; collisions with obstacles: 3; outside the fence: 0.8 s; at home at the end: "
                "4 of 6 MAVs\n"),
      std::string::npos)
      << text;
}

CampaignFacts facts(SeedRange seeds) {
  return {.line = "a, seeds to " + std::to_string(seeds.last),
          .seeds = seeds,
          .scenario = "a",
          .horizon_s = 2.0,
          .buildings = {{0.1, 2.0, 1.0 / 3.0, 4.0}}};
}

/// What a shard's file must carry as it is: numbers that are not defined, without end, or with all their digits.
MissionResult odd_mission(std::uint64_t seed) {
  MissionResult result = mission(seed, 2, 9);
  result.sources = {{.nuclide = "Cs 137\n# end", .p_W = {0.1, 1.0 / 3.0, -1e-300}, .activity_Bq = 2.0e9}};
  result.tracks = {{{0.1F, 2.0F, 3.0F}, {1.0F / 3.0F, 0.0F, -0.0F}}, {}};
  result.distance_min_m = std::numeric_limits<double>::infinity();
  Judgement& step = result.steps[1];
  step.localisation.found_by = {-1, 0};
  step.reported = {{.p_W = {1.0, 2.0, std::nextafter(3.0, 4.0)}, .activity_Bq = 5e-324}};
  step.errors = {{}, {.x_m = -0.1}};
  step.patches = 1;
  step.patch = {.centroid_m = 0.7, .area_rel = -0.01, .activity_rel = 0.0};
  return result;
}

TEST(ShardText, CarriesEachNumberAsItIs) {
  const std::vector<CampaignPart> parts = {{kNames, {odd_mission(4), odd_mission(5)}}, {{"a", "none", "joint"}, {}}};
  const CampaignResult whole{.parts = parts};
  const std::string text = shard_text(facts({4, 5}), {}, whole);
  const MergedCampaign merged = merge_shards(std::vector<ShardText>{{.name = "all", .text = text}});
  EXPECT_EQ(shard_text(merged.facts, {}, {.parts = merged.parts}), text);
  EXPECT_EQ(merged.facts.buildings, facts({4, 5}).buildings);
  const MissionResult wanted = odd_mission(5), &got = merged.parts.at(0).missions.at(1);
  const Judgement &end = wanted.steps[1], &got_end = got.steps.at(1);
  EXPECT_EQ(got.sources.at(0).nuclide, wanted.sources[0].nuclide);
  EXPECT_EQ(got.sources[0].p_W, wanted.sources[0].p_W);
  EXPECT_EQ(got.tracks, wanted.tracks);
  EXPECT_TRUE(std::signbit(got.tracks[0][1].z()));
  EXPECT_EQ(got.distance_min_m, wanted.distance_min_m);
  EXPECT_EQ(got_end.localisation.found_by, end.localisation.found_by);
  EXPECT_EQ(got_end.reported.at(0).p_W, end.reported[0].p_W);
  EXPECT_EQ(got_end.reported[0].activity_Bq, 5e-324);
  EXPECT_TRUE(std::isnan(got_end.errors.at(0).x_m));
  EXPECT_EQ(got_end.errors.at(1).x_m, -0.1);
  EXPECT_FALSE(got.steps[0].patch);
  EXPECT_EQ(got_end.patch.value().area_rel, -0.01);
}

/// What merging refuses, and what it must name.
TEST(MergeShards, RefusesWhatIsNotOneWholeCampaign) {
  const auto shard = [&](std::size_t index, SeedRange seeds, bool whole = true) {
    const CampaignResult result{.parts = {{kNames, {mission(seeds.first + index - 1, 2, 9)}}},
                                .missing = whole ? std::vector<std::string>{} : std::vector<std::string>{"a run"}};
    return ShardText{.name = "file" + std::to_string(index), .text = shard_text(facts(seeds), {index, 2}, result)};
  };
  const auto why = [](const std::vector<ShardText>& shards) -> std::string {
    try {
      return merge_shards(shards).facts.line.substr(0, 0) + "merged";
    } catch (const std::runtime_error& refusal) {
      return refusal.what();
    }
  };
  const ShardText one = shard(1, {4, 5}), two = shard(2, {4, 5});
  EXPECT_EQ(why({two, one}), "merged");
  EXPECT_EQ(why({one}), "--merge: missing shards: 2/2");
  EXPECT_EQ(why({one, one}), "--merge: file1: is shard 1, as file1 is");
  EXPECT_EQ(why({one, shard(2, {4, 6})}),
            "--merge: file2: is shard 2/2 of another campaign (a, seeds to 6) than file1, 1/2 (a, seeds to 5)");
  EXPECT_EQ(why({one, shard(2, {4, 5}, false)}), "--merge: file2: runs are missing, this shard must be flown again");
  EXPECT_EQ(why({one, {.name = "x", .text = "seed,t_s\n"}}), "--merge: x: is no file of --runs");
  for (std::size_t length = 0; length < two.text.size(); ++length) {
    EXPECT_NE(why({one, {.name = "cut", .text = two.text.substr(0, length)}}), "merged") << length;
    ShardText changed{.name = "changed", .text = two.text};
    changed.text[length] ^= 1;
    EXPECT_NE(why({one, changed}), "merged") << length;
  }
}

}  // namespace
}  // namespace comptonaut
