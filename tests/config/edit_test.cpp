// SPDX-License-Identifier: BSD-3-Clause
#include "config/edit.h"

#include <gtest/gtest.h>

#include "config/config.h"

namespace comptonaut {
namespace {

struct Values {
  double x_max_m = 0.0;
  double x_min_m = 0.0;
  std::vector<int> mavs;
  std::string name;
};

Values read_values(Config& config) {
  Values values;
  config.section("area", [&](Config& area) {
    area.read("x_min_m", values.x_min_m);
    area.read("x_max_m", values.x_max_m);
  });
  config.read("mavs", values.mavs);
  config.read("name", values.name);
  return values;
}

TEST(WithValues, SetsWhatWasThereAndWhatWasNotAndLeavesTheRest) {
  const std::string text = with_values("# a comment\narea: {x_min_m: -5, x_max_m: 50}\nname: north\n",
                                       {{"area.x_max_m", "70"}, {"mavs", "[1, 2]"}});
  const Values values = parse_config(text, "a.yaml", read_values);
  EXPECT_EQ(values.x_min_m, -5.0);
  EXPECT_EQ(values.x_max_m, 70.0);
  EXPECT_EQ(values.mavs, (std::vector<int>{1, 2}));
  EXPECT_EQ(values.name, "north");
}

TEST(WithValues, MakesMappingsThatAreMissing) {
  const Values values = parse_config(with_values("", {{"area.x_max_m", "70"}}), "a.yaml", read_values);
  EXPECT_EQ(values.x_max_m, 70.0);
}

TEST(WithValues, RefusesToGoThroughAValue) {
  EXPECT_THROW((void)with_values("area: 7", {{"area.x_max_m", "70"}}), ConfigError);
  EXPECT_THROW((void)with_values("[1, 2]", {{"area", "70"}}), ConfigError);
  EXPECT_THROW((void)with_values("a: [", {{"area", "70"}}), ConfigError);
}

}  // namespace
}  // namespace comptonaut
