// SPDX-License-Identifier: BSD-3-Clause
// What lcm-spy needs to read the messages.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "system/command.h"

namespace comptonaut {
namespace {

const std::string kScript = COMPTONAUT_SOURCE_DIR "/scripts/lcm-spy.sh";

TEST(LcmSpy, IsGivenAClassForEveryMessageType) {
  const Finished printed = run_command(kScript + " --print --build " COMPTONAUT_BINARY_DIR);
  ASSERT_EQ(printed.exit_code, 0) << printed.output;
  EXPECT_NE(printed.output.find("comptonaut-types.jar:/usr/share/java/lcm.jar"), std::string::npos) << printed.output;
  const Finished jar = run_command("jar tf " COMPTONAUT_BINARY_DIR "/comptonaut-types.jar");
  ASSERT_EQ(jar.exit_code, 0) << jar.output;
  int types = 0;
  for (const auto& entry : std::filesystem::directory_iterator(COMPTONAUT_SOURCE_DIR "/lcmtypes")) {
    if (entry.path().extension() != ".lcm") continue;
    ++types;
    const std::string name = "comptonaut/msg/" + entry.path().stem().string() + ".class";
    EXPECT_NE(jar.output.find(name), std::string::npos) << name;
  }
  EXPECT_GT(types, 20);
}

TEST(LcmSpy, SaysHowToUseIt) {
  const Finished help = run_command(kScript + " --help");
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_NE(help.output.find("--lcm-url"), std::string::npos) << help.output;
  EXPECT_EQ(run_command(kScript + " --nonsense").exit_code, 1);
  EXPECT_EQ(run_command(kScript + " --lcm-url").exit_code, 1);
}

}  // namespace
}  // namespace comptonaut
