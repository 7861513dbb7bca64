// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace comptonaut {

/// A folder below the build folder that belongs to the running test alone, since several tests run at a time.
inline std::filesystem::path scratch_folder() {
  const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
  std::string name = std::string(test.test_suite_name()) + "." + test.name();
  for (char& c : name) c = c == '/' ? '-' : c;
  const auto folder = std::filesystem::path(COMPTONAUT_BINARY_DIR) / "test-output" / name;
  std::filesystem::create_directories(folder);
  return folder;
}

inline std::filesystem::path scratch_file(const std::string& name) { return scratch_folder() / name; }

/// A file of the running test with this content.
inline std::filesystem::path scratch_file(const std::string& name, const std::string& content) {
  const auto file = scratch_file(name);
  std::ofstream(file, std::ios::binary) << content;
  return file;
}

}  // namespace comptonaut
