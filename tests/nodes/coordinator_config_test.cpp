// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/coordinator_config.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "config/config.h"

namespace comptonaut {
namespace {

TEST(CoordinatorConfig, ShipsForDronesAndForAGroundLaptop) {
  for (const std::string name : {"coordinator.yaml", "coordinator-ground.yaml"}) {
    const auto file = std::filesystem::path(COMPTONAUT_SOURCE_DIR) / "config" / name;
    const CoordinatorConfig config = load_config(file, read_coordinator_config);
    EXPECT_EQ(config.mavs, (std::vector<int>{1, 2, 3})) << name;
    EXPECT_EQ(config.response_table.filename(), "cs-137.csv") << name;
    EXPECT_EQ(config.estimator, "joint") << name;
  }
}

/// Whoever leads must come to the same plans.
TEST(CoordinatorConfig, SaysTheSameToDronesAndToAGroundLaptop) {
  const auto said = [](const char* name) {
    std::ifstream file(std::filesystem::path(COMPTONAUT_SOURCE_DIR) / "config" / name);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    return text.substr(text.find("\nmission:"));
  };
  EXPECT_EQ(said("coordinator.yaml"), said("coordinator-ground.yaml"));
}

TEST(CoordinatorConfig, RefusesNonsenseInOneLine) {
  const std::string good = "mission: 1\nresponse_table: t.csv\n";
  EXPECT_EQ(
      parse_config(good + "area: {x_min_m: 0, x_max_m: 9, y_min_m: 0, y_max_m: 8}", "a.yaml", read_coordinator_config)
          .area,
      (Area{0, 9, 0, 8}));
  for (const std::string bad :
       {"mavs: []", "mavs: [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16]", "plan_waypoints_max: 17",
        "mavs: [1, 1]", "mavs: [0]", "estimator: guess", "cell_m: -1", "x: 1",
        "area: {x_min_m: 9, x_max_m: 0, y_min_m: 0, y_max_m: 8}", "mlem: {iterations: 0}", "joint: {use: [pears]}",
        "joint: {use: []}", "joint: {gain_to_add: 10, loss_to_drop: 12}"}) {
    EXPECT_THROW((void)parse_config(good + bad, "a.yaml", read_coordinator_config), ConfigError) << bad;
  }
  EXPECT_THROW((void)parse_config("mission: 1", "a.yaml", read_coordinator_config), ConfigError);
}

}  // namespace
}  // namespace comptonaut
