// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "core/random.h"
#include "report/map_text.h"
#include "report/mission_json.h"
#include "report/scores.h"
#include "report/synthetic_mission.h"

namespace comptonaut {
namespace {

using nlohmann::json;

/// As the page's script reads it.
std::vector<int> letters_of(const std::string& text) {
  std::vector<int> result;
  for (std::size_t i = 0; i < text.size();) {
    const char letter = text[i++];
    std::size_t digits = 0;
    while (i + digits < text.size() && std::isdigit(text[i + digits])) ++digits;
    const int n = digits == 0 ? 1 : std::stoi(text.substr(i, digits));
    i += digits;
    const int level = letter == '-' ? -1 : static_cast<int>(std::strchr(kLetters, letter) - kLetters);
    result.insert(result.end(), static_cast<std::size_t>(n), level);
  }
  return result;
}

TEST(LambdaText, KeepsEachCellAndTheOrderOfLevels) {
  Random random(6);
  std::vector<std::uint8_t> levels;
  for (int i = 0; i < 3000; ++i) {
    const auto level = i % 11 == 0 ? kNoCell : static_cast<std::uint8_t>(random.uniform(0, 200));
    levels.insert(levels.end(), 1 + static_cast<std::size_t>(random.uniform(0, 4)), level);
  }
  const LevelScale scale{.top = 180, .levels = 80};
  const std::vector<int> letters = letters_of(lambda_text(levels, scale));
  ASSERT_EQ(letters.size(), levels.size());
  for (std::size_t i = 0; i < levels.size(); ++i) {
    if (levels[i] == kNoCell) {
      EXPECT_EQ(letters[i], -1) << "cell " << i;
    } else {
      EXPECT_NEAR(letters[i], 51.0 * std::clamp(levels[i] - 100, 0, 80) / 80, 0.5) << "cell " << i;
    }
  }
}

TEST(RunLengths, StartWithAFalseRunAndSumToTheSize) {
  EXPECT_EQ(run_lengths({}), "0");
  EXPECT_EQ(run_lengths({false, false, true}), "2,1");
  EXPECT_EQ(run_lengths({true, true, false, true}), "0,2,1,1");
}

TEST(Base64, EncodesTheBytesOfFloats) {
  EXPECT_EQ(base64({}), "");
  EXPECT_EQ(base64(std::vector<float>{1.0f}), "AACAPw==");
  EXPECT_EQ(base64(std::vector<float>{1.0f, -2.5f}), "AACAPwAAIMA=");
  EXPECT_EQ(base64(std::vector<float>{1.0f, -2.5f, 0.0f}), "AACAPwAAIMAAAAAA");
}

TEST(MissionJson, ParsesBackWithEveryPartOfTheSameLength) {
  const json page = json::parse(mission_to_json(record_of(synthetic_mission({.seed = 7, .duration_s = 10}))));
  const json& ticks = page["ticks"];
  for (const auto& [name, list] : ticks.items()) EXPECT_EQ(list.size(), 11u) << name;
  EXPECT_EQ(ticks["nearest_m"][3].size(), page["truth"]["sources"].size());
  EXPECT_EQ(ticks["estimates"].back().size(), page["final_sources"].size());
  EXPECT_EQ(page["drones"].size(), 3u);
  for (const json& drone : page["drones"]) {
    for (const auto& [name, list] : drone["track"].items())
      EXPECT_EQ(list.size(), drone["track"]["t_s"].size()) << name;
    for (const auto& [name, list] : drone["rates"].items()) EXPECT_EQ(list.size(), 10u) << name;
  }
  EXPECT_EQ(page["map"]["frames"].size(), 11u);
  for (const json& frame : page["map"]["frames"]) EXPECT_EQ(letters_of(frame["lambda"]).size(), 100u * 100u);
}

TEST(MissionJson, IsTheSameForTheSameMission) {
  const SyntheticConfig config{.seed = 8, .duration_s = 3, .edge_m = 20};
  EXPECT_EQ(mission_to_json(record_of(synthetic_mission(config))),
            mission_to_json(record_of(synthetic_mission(config))));
}

TEST(MissionJson, TellsOfClearGroundAndPatchesWhatCameLast) {
  MissionRecorder recorder;
  ClearanceTile tile{.utime = kSyntheticStart, .cell_m = 1.0, .tiles = 1};
  tile.cells = {{.key = {3, 4, -1}, .limit_Bq = 5e6}, {.key = {4, 4, -1}, .limit_Bq = kNothingKnown_Bq}};
  recorder.on_clearance(tile);
  tile.utime += kSecond_us;
  tile.cells = {{.key = {3, 4, -1}, .limit_Bq = 2e6}};
  recorder.on_clearance(tile);
  recorder.on_patches(
      {.utime = kSyntheticStart, .patches = {{.p_W = {1, 2, 0}, .area_m2 = 78.54, .activity_Bq = 4e9}}});
  const json page = json::parse(mission_to_json(std::move(recorder).finish()));
  EXPECT_EQ(page["clearance"]["cell_m"], 1.0);
  EXPECT_EQ(page["clearance"]["cells"], json::parse("[[3, 4, 2000.0]]"));
  ASSERT_EQ(page["patches"].size(), 1U);
  EXPECT_EQ(page["patches"][0]["radius_m"], 5.0);
}

TEST(MissionJson, OfNothingIsValidToo) {
  const json page = json::parse(mission_to_json({}));
  for (const char* part : {"map", "clearance", "patches"}) EXPECT_TRUE(page[part].is_null()) << part;
  EXPECT_EQ(page["headline"], "No estimate was recorded");
}

TEST(MissionJson, HoldsNoMarkupWhateverTheMessagesSay) {
  MissionRecorder recorder;
  recorder.on_status(
      1, {.daemon = "</script><b>", .state = "bad \xff bytes \"quoted\"", .counters = {{"<a>_refused", 1}}});
  recorder.on_refused(-1, "<CHANNEL>");
  const std::string text = mission_to_json(std::move(recorder).finish());
  EXPECT_EQ(text.find('<'), std::string::npos);
  EXPECT_EQ(json::parse(text)["daemons"][0]["name"], "MAV1 </script><b>");
  EXPECT_EQ(json::parse(text)["daemons"][0]["faults"]["<a>_refused"], 1);
}

TEST(MissionJson, ALargeMapIsThinnedToAPageOfAFewMegabytes) {
  MissionRecord record;
  record.map.grid = {0.5, 0, 0, 400, 400};
  Random random(9);
  for (int t = 0; t < 40; ++t) {
    MapFrame frame{
        .utime = t * kSecond_us, .grid = record.map.grid, .lambda_level = {}, .searched = std::vector<bool>(160'000)};
    for (int j = 0; j < 160'000; ++j) frame.lambda_level.push_back(static_cast<std::uint8_t>(random.uniform(80, 190)));
    record.map.frames.push_back(std::move(frame));
  }
  record.end_utime = 39 * kSecond_us;
  const std::string text = mission_to_json(record);
  EXPECT_LT(text.size(), 5'000'000u);
  const json frames = json::parse(text)["map"]["frames"];
  EXPECT_GT(frames.size(), 15u);
  EXPECT_EQ(frames.back()["t_s"], 39.0) << "the last map is always there";
}

TEST(Headline, SaysWhatWasFoundAndWhen) {
  MissionRecord record{.start_utime = kSyntheticStart, .end_utime = kSyntheticStart + 4 * kSecond_us};
  record.truth = Truth{.area = {0, 50, 0, 50}, .sources = {{"Cs-137", {1, 1, 0}, 2e9}, {"Cs-137", {30, 1, 0}, 2e9}}};
  const auto add = [&](int t_s, std::vector<double> xs) {
    SourceReport report{.utime = kSyntheticStart + t_s * kSecond_us, .estimator = "joint"};
    for (const double x : xs) report.sources.push_back({.nuclide = "Cs-137", .p_W = {x, 1, 0}, .activity_Bq = 1.83e9});
    record.reports.push_back(report);
  };
  const auto text = [&] { return headline(record, score(record)); };
  add(1, {1, 30});
  add(2, {1});
  add(3, {1, 30.5, 45});
  EXPECT_EQ(text(), "2 of 2 sources found within 2 m, 1 false, at the end of 4 s");
  add(4, {1, 31});
  EXPECT_EQ(text(), "2 of 2 sources found within 2 m, 0 false, after 4 s");
  record.truth.reset();
  EXPECT_EQ(text(), "2 sources reported after 4 s, the strongest 1.83 GBq at (1.0, 1.0) m");
  add(5, {});
  EXPECT_EQ(text(), "No source reported after 4 s");
}

TEST(ActivityText, HasThreeDigitsAndAPrefix) {
  EXPECT_EQ(activity_text(2e9), "2 GBq");
  EXPECT_EQ(activity_text(173.6e6), "174 MBq");
  EXPECT_EQ(activity_text(1234), "1.23 kBq");
  EXPECT_EQ(activity_text(0.5), "0.5 Bq");
}

}  // namespace
}  // namespace comptonaut
