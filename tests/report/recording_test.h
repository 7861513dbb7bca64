// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "report/synthetic_mission.h"
#include "scratch.h"

namespace comptonaut {

/// A test with a folder of its own, logs in it, and the command line.
class Recording : public testing::Test {
 protected:
  ~Recording() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path log_of(const SyntheticConfig& config) {
    write_log(synthetic_mission(config), folder_ / "mission.log");
    return folder_ / "mission.log";
  }
  std::filesystem::path write(const std::string& name, const std::string& bytes) {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }
  static std::string bytes_of(const std::filesystem::path& file) {
    std::stringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
  }
  /// Output of the command line, both streams; its exit code in exit_code_.
  std::string run(const std::string& command) {
    std::string output;
    FILE* pipe = popen((command + " 2>&1").c_str(), "r");
    char buffer[4096];
    while (const std::size_t n = fread(buffer, 1, sizeof buffer, pipe)) output.append(buffer, n);
    exit_code_ = WEXITSTATUS(pclose(pipe));
    return output;
  }
  std::string report(const std::filesystem::path& log, const std::string& options = "") {
    return run("timeout 60 " COMPTONAUT_BINARY_DIR "/bin/comptonaut report " + log.string() + " --out " +
               (folder_ / "page.html").string() + " " + options);
  }

  std::filesystem::path folder_ = scratch_folder();
  int exit_code_ = 0;
};

}  // namespace comptonaut
