// SPDX-License-Identifier: BSD-3-Clause
#include "config/overlay.h"

#include <gtest/gtest.h>

#include <fstream>

#include "config/config.h"
#include "scratch.h"

namespace comptonaut {
namespace {

std::filesystem::path written(const std::string& text) { return scratch_file("a.yaml", text); }

struct Settings {
  double a = 0.0, c = 0.0, d = 0.0;
  std::vector<int> list;
};

Settings read_settings(Config& config) {
  Settings settings;
  config.require("a", settings.a);
  config.section("b", [&](Config& b) {
    b.require("c", settings.c);
    b.read("d", settings.d);
  });
  config.read("list", settings.list);
  return settings;
}

TEST(Overlay, PutsValuesInPlaceOfTheFilesOwnAndKeepsTheRest) {
  const auto file = written("a: 1  # one\nb: {c: 2}\n");
  const std::string text = overlaid(file, {{{"b", "d"}, "4.5"}, {{"list"}, "[7, 8]"}, {{"a"}, "0.1"}});
  const Settings settings = parse_config(text, "out.yaml", read_settings);
  EXPECT_EQ(settings.a, 0.1);
  EXPECT_EQ(settings.c, 2.0);
  EXPECT_EQ(settings.d, 4.5);
  EXPECT_EQ(settings.list, (std::vector<int>{7, 8}));
}

TEST(Overlay, MakesMappingsThatAreMissing) {
  const std::string text = overlaid(written("a: 1\n"), {{{"b", "c"}, "3"}});
  EXPECT_EQ(parse_config(text, "out.yaml", read_settings).c, 3.0);
}

TEST(Overlay, RefusesWhatIsNoMappingOrNoFile) {
  EXPECT_THROW((void)overlaid(written("a: 1\n"), {{{"a", "x"}, "3"}}), ConfigError);
  EXPECT_THROW((void)overlaid("no-such-file.yaml", {}), ConfigError);
  EXPECT_THROW((void)overlaid(written("a: [1\n"), {}), ConfigError);
}

}  // namespace
}  // namespace comptonaut
