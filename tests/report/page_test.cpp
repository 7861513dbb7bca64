// SPDX-License-Identifier: BSD-3-Clause
#include "report/page.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "core/random.h"
#include "report/read_mission.h"
#include "report/recording_test.h"

namespace comptonaut {
namespace {

constexpr SyntheticConfig kShort{.seed = 11, .duration_s = 6, .edge_m = 20};

TEST_F(Recording, ReadsAsWhatWasSent) {
  const MissionRecord sent = record_of(synthetic_mission(kShort)), read = read_mission(log_of(kShort));
  EXPECT_EQ(read.messages, sent.messages);
  EXPECT_EQ(read.reports.size(), 7u);
  EXPECT_EQ(read.map.lambda_Bq, sent.map.lambda_Bq);
  EXPECT_EQ(read.drones.at(2).total.singles, sent.drones.at(2).total.singles);
  EXPECT_NEAR(read.drones.at(2).distance_m, sent.drones.at(2).distance_m, 1e-6);
  EXPECT_EQ(read.daemons.size(), 13u);
  EXPECT_TRUE(read.refused.empty() && read.damage.empty());
}

TEST_F(Recording, MakesASelfContainedPage) {
  const std::string page = page_html(read_mission(log_of(kShort)));
  std::string shell = page;  // without the mission's data, which hold no markup
  const std::size_t data = shell.find("{\"buildings_m\"");
  ASSERT_NE(data, std::string::npos);
  shell.erase(data, shell.find('<', data) - data);
  const std::string svg_name = "http://www.w3.org/2000/svg";  // a name, not an address
  shell.replace(shell.find(svg_name), svg_name.size(), "");
  EXPECT_LT(shell.size(), 100'000u);
  const std::regex outside(
      R"((src|href|action|srcset)=(?!["']?data:)|url\((?!#)|@import|fetch\(|import\(|XMLHttp|https?:)");
  std::smatch match;
  EXPECT_FALSE(std::regex_search(shell, match, outside)) << match.str();
  EXPECT_EQ(page.find("{{"), std::string::npos);
}

TEST_F(Recording, OfWhichTheEndIsMissingGivesWhatIsThere) {
  const std::string bytes = bytes_of(log_of(kShort));
  Random random(12);
  for (int round = 0; round < 25; ++round) {
    const auto n = static_cast<std::size_t>(random.uniform(0, static_cast<double>(bytes.size())));
    const std::filesystem::path cut = write("cut.log", bytes.substr(0, n));
    try {
      const MissionRecord record = read_mission(cut);
      EXPECT_GT(record.messages, 0) << n << " bytes";
      EXPECT_FALSE(page_html(record).empty()) << n << " bytes";
    } catch (const std::runtime_error& error) {
      EXPECT_LT(n, 2000u) << error.what();
    }
  }
}

TEST_F(Recording, WithDamagedBytesNeverCrashesAndCountsWhatItRefuses) {
  const std::string bytes = bytes_of(log_of({.seed = 13, .duration_s = 2, .edge_m = 8}));
  Random random(14);
  std::int64_t refused = 0;
  for (int round = 0; round < 60; ++round) {
    std::string damaged = bytes;
    for (int flip = 0; flip < 40; ++flip) {
      const auto at = static_cast<std::size_t>(random.uniform(0, static_cast<double>(damaged.size())));
      damaged[at] = static_cast<char>(random() & 0xff);
    }
    try {
      const MissionRecord record = read_mission(write("damaged.log", damaged));
      for (const auto& [channel, count] : record.refused) refused += count;
      EXPECT_FALSE(page_html(record).empty()) << "round " << round;
    } catch (const std::runtime_error&) {  // damaged at its first event
    }
  }
  EXPECT_GT(refused, 0);
}

TEST_F(Recording, CommandSaysTheResultAndWritesThePage) {
  const std::string output = report(log_of(kShort));
  EXPECT_EQ(exit_code_, 0) << output;
  EXPECT_NE(output.find("sources found within 2 m"), std::string::npos) << output;
  EXPECT_GT(std::filesystem::file_size(folder_ / "page.html"), 50'000u);
}

TEST_F(Recording, ShowsTheBuildingsOfTheCoordinatorsTerrain) {
  const std::string config = (folder_ / "coordinator.yaml").string();
  const std::string fitted =
      run("cd " COMPTONAUT_SOURCE_DIR " && " COMPTONAUT_BINARY_DIR
          "/bin/comptonaut scenario config/scenarios/town.yaml --coordinator config/coordinator.yaml --out " +
          config);
  ASSERT_EQ(exit_code_, 0) << fitted;
  const auto buildings = [&](const std::string& options) {
    const std::string output = report(log_of(kShort), options);
    EXPECT_EQ(exit_code_, 0) << output;
    const std::string page = bytes_of(folder_ / "page.html"), name = "\"buildings_m\":[";
    return page.substr(page.find(name) + name.size(), 1);
  };
  EXPECT_EQ(buildings(""), "]");
  EXPECT_EQ(buildings("--config " + config), "[");
  const std::string output = report(log_of(kShort), "--config /nowhere.yaml");
  EXPECT_EQ(exit_code_, 1);
  EXPECT_NE(output.find("/nowhere.yaml"), std::string::npos) << output;
}

TEST_F(Recording, WithoutAnyEstimateIsSaidSo) {
  auto sent = synthetic_mission(kShort);
  std::erase_if(sent, [](const Sent& one) { return one.channel == "SOURCES"; });
  write_log(sent, folder_ / "mission.log");
  const std::string output = report(folder_ / "mission.log");
  EXPECT_EQ(exit_code_, 0) << "what there is can be seen";
  EXPECT_TRUE(output.starts_with("comptonaut: " + (folder_ / "mission.log").string() + ": No SOURCES message"))
      << output;
  EXPECT_NE(output.find("No estimate was recorded"), std::string::npos) << output;
}

TEST_F(Recording, ThatIsNoneGivesOneClearLineAndExitCode1) {
  std::vector<Sent> foreign = {{.channel = "POSE_BODY", .message = StampedPose{.utime = kSyntheticStart}}};
  write_log(foreign, folder_ / "foreign.log");
  const std::vector<std::filesystem::path> logs = {folder_ / "missing.log", write("empty.log", ""),
                                                   write("text.log", "time,x,y\n1,2,3\n"), folder_ / "foreign.log",
                                                   folder_};
  for (const std::filesystem::path& log : logs) {
    const std::string output = report(log);
    EXPECT_EQ(exit_code_, 1) << log << ": " << output;
    EXPECT_NE(output.find(log.string()), std::string::npos) << log << ": " << output;
    EXPECT_EQ(std::count(output.begin(), output.end(), '\n'), 1) << output;
  }
}

TEST_F(Recording, ToAPlaceThatCannotBeWrittenGivesExitCode1) {
  const std::string output =
      run(COMPTONAUT_BINARY_DIR "/bin/comptonaut report " + log_of(kShort).string() + " --out /nowhere/r.html");
  EXPECT_EQ(exit_code_, 1);
  EXPECT_NE(output.find("/nowhere/r.html"), std::string::npos) << output;
}

}  // namespace
}  // namespace comptonaut
