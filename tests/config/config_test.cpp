// SPDX-License-Identifier: BSD-3-Clause
#include "config/config.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scratch.h"

namespace comptonaut {
namespace {

struct Settings {
  double speed_max_m_s = 8.0;
  int lanes = 3;
  bool ideal = false;
  std::string strategy = "zigzag";
  Eigen::Vector3d p_BD_m = Eigen::Vector3d::Zero();
  std::filesystem::path table;
  std::vector<double> x_m;
};

Settings read_settings(Config& config) {
  Settings settings;
  config.read("speed_max_m_s", settings.speed_max_m_s, {.min = 0.1, .max = 30.0});
  config.read("lanes", settings.lanes, {.min = 1});
  config.read("ideal", settings.ideal);
  config.read("strategy", settings.strategy, {"zigzag", "none"});
  config.section("extrinsics", [&](Config& section) { section.require("p_BD_m", settings.p_BD_m); });
  config.read("table", settings.table);
  config.each("sources", [&](Config& source) { source.require("x_m", settings.x_m.emplace_back()); });
  return settings;
}

std::string refusal(const std::string& text) {
  try {
    (void)parse_config(text, "dir/a.yaml", read_settings);
  } catch (const ConfigError& e) {
    return e.what();
  }
  return "accepted";
}

TEST(Config, DefaultsStayWhereAKeyIsAbsent) {
  const Settings settings = parse_config("", "a.yaml", read_settings);
  EXPECT_EQ(settings.speed_max_m_s, 8.0);
  EXPECT_EQ(settings.strategy, "zigzag");
  EXPECT_TRUE(settings.table.empty());
}

TEST(Config, ReadsEachKindOfValue) {
  const Settings settings = parse_config(
      "speed_max_m_s: 4\nlanes: 5\nideal: true\nstrategy: none\nextrinsics: {p_BD_m: [0.1, 0, -0.05]}\n"
      "table: t.csv\nsources: [{x_m: 1}, {x_m: 2.5}]\n",
      "dir/a.yaml", read_settings);
  EXPECT_EQ(settings.speed_max_m_s, 4.0);
  EXPECT_EQ(settings.lanes, 5);
  EXPECT_TRUE(settings.ideal);
  EXPECT_EQ(settings.strategy, "none");
  EXPECT_EQ(settings.p_BD_m, Eigen::Vector3d(0.1, 0, -0.05));
  EXPECT_EQ(settings.table, "dir/t.csv");
  EXPECT_EQ(settings.x_m, (std::vector<double>{1, 2.5}));
}

TEST(Config, RefusalsNameFileLineKeyValueAndRange) {
  EXPECT_EQ(refusal("\nspeed_max_m_s: 70"), "dir/a.yaml:2: speed_max_m_s: '70' is not allowed, must be 0.1 to 30");
  EXPECT_EQ(refusal("lanes: 2.5"), "dir/a.yaml:1: lanes: '2.5' is not allowed, must be a whole number, at least 1");
  EXPECT_EQ(refusal("strategy: zag"), "dir/a.yaml:1: strategy: 'zag' is not allowed, must be one of: zigzag, none");
  EXPECT_EQ(refusal("extrinsics: {}"), "dir/a.yaml:1: extrinsics.p_BD_m: is missing");
  EXPECT_EQ(refusal("extrinsics: {p_BD_m: [1, 2]}"),
            "dir/a.yaml:1: extrinsics.p_BD_m: 2 numbers, must be three: x, y, z");
  EXPECT_EQ(refusal("sources: [{x_m: 1}, {y_m: 2}]"), "dir/a.yaml:1: sources[1].x_m: is missing");
  EXPECT_EQ(refusal("lanes: 1\nlanes: 2"), "dir/a.yaml:2: lanes: stands twice");
  EXPECT_EQ(refusal("extrinsics: {p_BD_m: [1, 2, 3], q: 1}"),
            "dir/a.yaml:1: extrinsics.q: unknown key, known here: p_BD_m");
  EXPECT_EQ(refusal("speed_max_m_s: .nan"), "dir/a.yaml:1: speed_max_m_s: '.nan' is not allowed, must be 0.1 to 30");
  EXPECT_EQ(refusal("ideal: 7"), "dir/a.yaml:1: ideal: '7' is not allowed, must be true or false");
  EXPECT_EQ(refusal("[1, 2]"), "dir/a.yaml: a list is not allowed, must be a mapping");
  EXPECT_EQ(refusal("lanes: [1"), "dir/a.yaml:1: not YAML: end of sequence flow not found");
}

TEST(Config, ARefusalIsOneLineWhateverTheFileHolds) {
  const std::string long_value(5000, '7');
  for (const std::string& yaml : {std::string("lanes: \"1\\n2\""), "strategy: " + long_value,
                                  std::string("\"a\\nb\": 1"), std::string("N\x01\x7f\n"), long_value + ": 1"}) {
    const std::string what = refusal(yaml);
    EXPECT_TRUE(what.starts_with("dir/a.yaml"));
    EXPECT_LT(what.size(), 600u);
    EXPECT_EQ(std::count_if(what.begin(), what.end(), [](unsigned char c) { return c < ' ' || c == 0x7f; }), 0) << what;
  }
}

TEST(Config, AFileOfCommentsLeavesEveryDefault) {
  const auto file = scratch_file("comments.yaml", "# as it comes\n");
  EXPECT_EQ(load_config(file, read_settings).speed_max_m_s, Settings{}.speed_max_m_s);
}

TEST(Config, AFileThatLostItsContentIsRefused) {
  EXPECT_THROW(load_config(scratch_file("empty.yaml", ""), read_settings), ConfigError);
}

TEST(Config, AMissingFileIsOneClearLine) {
  try {
    (void)load_config("/no/such.yaml", read_settings);
    FAIL();
  } catch (const ConfigError& e) {
    EXPECT_STREQ(e.what(), "/no/such.yaml: cannot be read, must be a YAML file");
  }
}

}  // namespace
}  // namespace comptonaut
