// SPDX-License-Identifier: BSD-3-Clause
// comptonaut campaign, flown in one go and in shards.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <vector>

#include "scratch.h"
#include "system/command.h"

namespace comptonaut {
namespace {

std::string content(const std::string& name) {
  std::ifstream in(scratch_file(name), std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

Finished campaign(const std::string& options) {
  return run_command("cd " + scratch_folder().string() + " && { " + COMPTONAUT_BINARY_DIR +
                     "/bin/comptonaut campaign --jobs 1 " + options + "; }");
}

/// Without the lines that tell the processor's time.
std::string without_speed(const std::string& tables) {
  std::istringstream lines(tables);
  std::string rest;
  for (std::string line; std::getline(lines, line);) {
    if (line.find("x real time") == std::string::npos) rest += line + "\n";
  }
  return rest;
}

/// Each number that stands right behind `words`.
std::vector<double> numbers_after(const std::string& words, const std::string& text) {
  std::vector<double> numbers;
  for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) {
    const char* begin = text.c_str() + at + words.size();
    char* end = nullptr;
    const double number = std::strtod(begin, &end);
    if (end != begin) numbers.push_back(number);
  }
  return numbers;
}

/// The page's table has what the tables on stdout say of each configuration.
void expect_summed_up(const std::string& page, const std::string& tables) {
  for (const auto& [key, words] : {std::pair("distance_min_m", "smallest distance between MAVs: "),
                                   {"collisions", "collisions with obstacles: "},
                                   {"outside_s", "outside the fence: "},
                                   {"at_home", "at home at the end: "}}) {
    const auto shown = numbers_after(fmt::format("\"{}\":", key), page), told = numbers_after(words, tables);
    ASSERT_EQ(told.size(), 2u) << words;
    ASSERT_EQ(shown.size(), 2u) << key;
    for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(shown[i], told[i], 0.051) << key << ' ' << i;
  }
  EXPECT_EQ(numbers_after("\"flights\":", page), (std::vector<double>{6.0, 6.0}));
}

TEST(CampaignCommand, MergesShardsToTheBytesOfOneGo) {
  scratch_file("s.yaml",
               "name: s\nhorizon_s: 15\narea: {x_min_m: 0, x_max_m: 20, y_min_m: 0, y_max_m: 20}\n"
               "mavs: {count: 2}\nsources_by_seed: {activities_Bq: [4.0e9, 2.0e9]}\n"
               "world: {boxes: [{x_min_m: 8, x_max_m: 11, y_min_m: 8, y_max_m: 10, z_max_m: 3}]}\n");
  const std::string fly = "--scenario s.yaml --config " + std::string(COMPTONAUT_SOURCE_DIR) +
                          "/config/coordinator.yaml --seeds 3:5 --strategy zigzag,information ";
  const auto files = [](const std::string& name) {
    return "--csv " + name + ".csv --per-source " + name + "-sources.csv --page " + name + ".html ";
  };
  const Finished whole = campaign(fly + files("whole") + "2> progress");
  ASSERT_EQ(whole.exit_code, 0) << whole.output;
  EXPECT_NE(content("progress").find("\n6 of 6 missions done, 100 % of the work; "), std::string::npos)
      << content("progress");
  expect_summed_up(content("whole.html"), whole.output);
  EXPECT_NE(content("whole.html").find("\"buildings_m\":[[8.0,11.0,8.0,10.0]]"), std::string::npos);
  for (const std::string shard : {"1", "2", "3", "4"}) {
    const Finished part = campaign(fly + "--shard " + shard + "/4 --runs " + shard + ".runs");
    ASSERT_EQ(part.exit_code, 0) << part.output;
  }
  const Finished merged = campaign("--merge 4.runs 2.runs 1.runs 3.runs " + files("merged"));
  ASSERT_EQ(merged.exit_code, 0) << merged.output;
  for (const std::string end : {".csv", "-sources.csv", ".html"}) {
    EXPECT_FALSE(content("whole" + end).empty()) << end;
    EXPECT_TRUE(content("merged" + end) == content("whole" + end)) << end;
  }
  EXPECT_EQ(without_speed(merged.output), without_speed(whole.output));

  const Finished lacking = campaign("--merge 4.runs 2.runs 3.runs --page lacking.html");
  EXPECT_EQ(lacking.exit_code, 1);
  EXPECT_NE(lacking.output.find("missing shards: 1/4"), std::string::npos) << lacking.output;
  const Finished twice = campaign("--merge 4.runs 2.runs 1.runs 3.runs 2.runs --page twice.html");
  EXPECT_EQ(twice.exit_code, 1);
  EXPECT_NE(twice.output.find("2.runs: is shard 2, as 2.runs is"), std::string::npos) << twice.output;
}

}  // namespace
}  // namespace comptonaut
