// SPDX-License-Identifier: BSD-3-Clause
// comptonaut campaign, flown in one go and in shards.
#include <gtest/gtest.h>

#include "scratch.h"
#include "system/command.h"

namespace comptonaut {
namespace {

std::string content(const std::string& name) {
  std::ifstream in(scratch_file(name), std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

Finished campaign(const std::string& options) {
  return run_command("cd " + scratch_folder().string() + " && " + COMPTONAUT_BINARY_DIR +
                     "/bin/comptonaut campaign --jobs 1 " + options);
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

TEST(CampaignCommand, MergesShardsToTheBytesOfOneGo) {
  scratch_file("s.yaml",
               "name: s\nhorizon_s: 15\narea: {x_min_m: 0, x_max_m: 20, y_min_m: 0, y_max_m: 20}\n"
               "mavs: {count: 2}\nsources_by_seed: {activities_Bq: [4.0e9, 2.0e9]}\n");
  const std::string fly = "--scenario s.yaml --config " + std::string(COMPTONAUT_SOURCE_DIR) +
                          "/config/coordinator.yaml --seeds 3:5 --strategy zigzag,information ";
  const auto files = [](const std::string& name) {
    return "--csv " + name + ".csv --per-source " + name + "-sources.csv --page " + name + ".html ";
  };
  const Finished whole = campaign(fly + files("whole"));
  ASSERT_EQ(whole.exit_code, 0) << whole.output;
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
