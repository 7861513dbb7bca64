// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "world/voxels.h"

namespace comptonaut {
namespace {

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string error_of(const std::string& bytes) {
  const std::filesystem::path file = scratch_file("bad.bt");
  std::ofstream(file, std::ios::binary) << bytes;
  try {
    const World world = World::load(file);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

testing::AssertionResult says(const std::string& error, const std::string& part) {
  const bool found = error.find(part) != std::string::npos;
  return found ? testing::AssertionSuccess()
               : testing::AssertionFailure() << "'" << error << "' lacks '" << part << "'";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

struct Files {
  std::string binary, full;
};

Files small_map() {
  const octomap::OcTree tree = octree_of(random_voxels(7, 4));
  tree.writeBinaryConst(scratch_file("small.bt").string());
  tree.write(scratch_file("small.ot").string());
  return {bytes_of(scratch_file("small.bt")), bytes_of(scratch_file("small.ot"))};
}

TEST(OctoMapFile, SaysWhatIsWrongWithAFileThatIsNone) {
  const Files map = small_map();
  EXPECT_EQ(error_of(map.binary), "");
  EXPECT_EQ(error_of(map.full), "");
  EXPECT_TRUE(says(error_of("Hello"), "it begins neither with"));
  EXPECT_TRUE(says(error_of("# Octomap OcTree binary file\nid OcTree\n"), "no line 'data'"));
  EXPECT_TRUE(says(error_of(replaced(map.full, "id OcTree", "id ColorOcTree")), "its id is 'ColorOcTree'"));
  EXPECT_TRUE(says(error_of(replaced(map.full, "res 0.5", "res -0.5")), "its res is -0.5 m"));
  EXPECT_TRUE(says(error_of(map.binary + "x"), "left over"));
  EXPECT_TRUE(says(error_of("Hello"), "bad.bt: "));
  EXPECT_THROW((void)World::load(scratch_file("absent.bt")), std::runtime_error);
  EXPECT_THROW((void)World::load(COMPTONAUT_BINARY_DIR), std::runtime_error);
}

TEST(OctoMapFile, IsRefusedWhereverItIsCutShort) {
  const Files map = small_map();
  for (const std::string& bytes : {map.binary, map.full}) {
    const std::size_t data_at = bytes.find("data\n") + 5;
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      if (size == data_at) continue;  // a map without nodes
      EXPECT_NE(error_of(bytes.substr(0, size)), "") << "cut to " << size << " of " << bytes.size();
    }
  }
}

TEST(OctoMapFile, CrashesNothingWhateverItHolds) {
  const Files map = small_map();
  Random random(8);
  for (int i = 0; i < 800; ++i) {
    std::string bytes = i % 2 == 0 ? map.binary : map.full;
    const std::size_t from = i % 3 == 0 ? 0 : bytes.find("data\n");
    for (int k = 0; k < 1 + i % 5; ++k) {
      bytes[from + random() % (bytes.size() - from)] = static_cast<char>(random());
    }
    const std::string error = error_of(bytes);
    if (!error.empty()) continue;
    const World world = World::load(scratch_file("bad.bt"));
    EXPECT_NO_THROW((void)world.surface_cells({-3, 3, -3, 3}, 0.5)) << "file " << i;
    EXPECT_NO_THROW((void)world.at({0.1, 0.2, 0.3})) << "file " << i;
  }
}

}  // namespace
}  // namespace comptonaut
