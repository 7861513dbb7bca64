// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sim/campaign_csv.h"
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

/// What merging refuses, and what it must name.
TEST(MergeShards, RefusesWhatIsNotOneWholeCampaign) {
  const auto shard = [&](std::size_t index, SeedRange seeds, bool whole = true) {
    const std::vector<CampaignPart> parts = {{kNames, {mission(seeds.first + index - 1, 2, 9)}}};
    return ShardText{.name = "file" + std::to_string(index),
                     .text = shard_mark("a, seeds to " + std::to_string(seeds.last), {index, 2}) + campaign_csv(parts) +
                             shard_end(whole)};
  };
  const auto why = [](const std::vector<ShardText>& shards) -> std::string {
    try {
      return merge_shards(shards).substr(0, 0) + "merged";
    } catch (const std::runtime_error& refusal) {
      return refusal.what();
    }
  };
  const ShardText one = shard(1, {4, 5}), two = shard(2, {4, 5});
  EXPECT_EQ(why({two, one}), "merged");
  EXPECT_EQ(why({one}), "--merge: missing shards: 2/2");
  EXPECT_EQ(why({one, one}), "--merge: file1: is shard 1, as file1 is");
  EXPECT_EQ(why({one, shard(2, {4, 6})}), "--merge: file2: is of another campaign than file1");
  EXPECT_EQ(why({one, shard(2, {4, 5}, false)}), "--merge: file2: runs are missing, this shard must be flown again");
  EXPECT_EQ(why({one, {.name = "x", .text = "seed,t_s\n"}}), "--merge: x: is no CSV that --shard wrote");
  for (std::size_t length = 0; length < two.text.size(); ++length) {
    EXPECT_NE(why({one, {.name = "cut", .text = two.text.substr(0, length)}}), "merged") << length;
  }
}

}  // namespace
}  // namespace comptonaut
