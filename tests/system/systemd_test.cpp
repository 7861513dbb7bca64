// SPDX-License-Identifier: BSD-3-Clause
// The units that put the daemons on a drone.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "system/command.h"

namespace comptonaut {
namespace {

namespace fs = std::filesystem;

const fs::path kUnits = fs::path(COMPTONAUT_SOURCE_DIR) / "systemd";
const fs::path kPrograms = fs::path(COMPTONAUT_BINARY_DIR) / "bin";
const std::string kInstalledIn = "/usr/local/bin/";
const std::vector<std::string> kDaemons = {"detector-reader", "pose-bridge", "mapper",
                                           "team-link",       "coordinator", "simulator"};

std::string read(const fs::path& file) {
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

fs::path unit_of(const std::string& daemon) { return kUnits / ("comptonaut-" + daemon + "@.service"); }

std::string exec_start(const std::string& unit) {
  std::smatch match;
  return std::regex_search(unit, match, std::regex("ExecStart=(.*)")) ? match[1].str() : "";
}

/// The units as they are installed, but for where the programs are.
class Units : public testing::Test {
 protected:
  fs::path folder_ = fs::path(testing::TempDir()) / ("units_" + std::to_string(getpid()));

  void SetUp() override {
    fs::create_directories(folder_);
    for (const auto& entry : fs::directory_iterator(kUnits)) {
      const std::string here =
          std::regex_replace(read(entry.path()), std::regex(kInstalledIn), kPrograms.string() + "/");
      std::ofstream(folder_ / entry.path().filename()) << here;
    }
  }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] Finished verify() const {
    return run_command("systemd-analyze verify --man=no " + folder_.string() + "/*");
  }
};

// It returns 0 even on keys that it does not know.
TEST_F(Units, PleaseSystemdWithoutAWord) {
  const Finished verified = verify();
  EXPECT_EQ(verified.exit_code, 0);
  EXPECT_EQ(verified.output, "");
}

TEST_F(Units, WouldNotPleaseItWithAMistake) {
  std::ofstream(folder_ / "comptonaut-mapper@.service", std::ios::app) << "\n[Service]\nRestartt=no\n";
  EXPECT_NE(verify().output.find("Restartt"), std::string::npos);
}

TEST(Unit, OfEachDaemonRestartsItWithALimit) {
  for (const std::string& daemon : kDaemons) {
    const std::string unit = read(unit_of(daemon));
    for (const std::string line :
         {"Restart=on-failure", "StartLimitBurst=", "StartLimitIntervalSec=", "PartOf=comptonaut@%i.target",
          "WantedBy=comptonaut@%i.target", "DynamicUser=yes", "ProtectSystem=strict"}) {
      EXPECT_NE(unit.find(line), std::string::npos) << line << " in the unit of " << daemon;
    }
  }
}

TEST(Unit, StartsItsDaemonWithOptionsThatItHasAndAConfigurationThatShips) {
  for (const std::string& daemon : kDaemons) {
    const std::string command = exec_start(read(unit_of(daemon)));
    ASSERT_TRUE(command.starts_with(kInstalledIn + "comptonaut-" + daemon + " ")) << command;
    const Finished help = run_command((kPrograms / ("comptonaut-" + daemon)).string() + " --help");
    ASSERT_EQ(help.exit_code, 0) << daemon << ": " << help.output;
    const std::regex kOption("--[a-z-]+");
    for (std::sregex_iterator option(command.begin(), command.end(), kOption), end; option != end; ++option) {
      EXPECT_NE(help.output.find(option->str()), std::string::npos) << daemon << " has no " << option->str();
    }
    EXPECT_TRUE(fs::exists(fs::path(COMPTONAUT_SOURCE_DIR) / "config" / (daemon + ".yaml"))) << daemon;
  }
}

TEST(Installation, KeepsConfigurationThatSomebodyChanged) {
  const fs::path root = fs::path(testing::TempDir()) / ("install_" + std::to_string(getpid()));
  const std::string install = "DESTDIR=" + root.string() +
                              " cmake -Dconfig_folder=" COMPTONAUT_SOURCE_DIR "/config -P " COMPTONAUT_SOURCE_DIR
                              "/daemons/install_config.cmake";
  const fs::path folder = root / "etc/comptonaut";
  EXPECT_EQ(run_command(install).exit_code, 0);
  EXPECT_EQ(read(folder / "team-link.yaml"), read(COMPTONAUT_SOURCE_DIR "/config/team-link.yaml"));
  std::ofstream(folder / "mapper.yaml") << "changed";
  fs::remove(folder / "team-link.yaml");
  EXPECT_EQ(run_command(install).exit_code, 0);
  EXPECT_EQ(read(folder / "mapper.yaml"), "changed");
  EXPECT_TRUE(fs::exists(folder / "team-link.yaml"));
  fs::remove_all(root);
}

}  // namespace
}  // namespace comptonaut
