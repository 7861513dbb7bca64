// SPDX-License-Identifier: BSD-3-Clause
// The architecture as the sources have it: who includes whom, who alone touches which library.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace comptonaut {
namespace {

namespace fs = std::filesystem;
const fs::path kRoot = COMPTONAUT_SOURCE_DIR;

std::vector<std::string> lines_of(const fs::path& file) {
  std::ifstream in(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

bool has_extension(const fs::path& file, const std::set<std::string>& extensions) {
  return extensions.contains(file.extension().string()) || extensions.contains(file.filename().string());
}

std::vector<fs::path> files_below(const std::vector<std::string>& folders, const std::set<std::string>& extensions) {
  std::vector<fs::path> files;
  for (const std::string& folder : folders) {
    if (!fs::exists(kRoot / folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
      if (entry.is_regular_file() && has_extension(entry.path(), extensions)) files.push_back(entry.path());
    }
  }
  return files;
}

std::vector<fs::path> sources(const std::vector<std::string>& folders) { return files_below(folders, {".h", ".cpp"}); }

struct Include {
  fs::path file;  ///< relative to the root
  std::string what;
};

std::vector<Include> includes(const std::vector<std::string>& folders) {
  static const std::regex kInclude(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"].*)");
  std::vector<Include> found;
  for (const fs::path& file : sources(folders)) {
    for (const std::string& line : lines_of(file)) {
      std::smatch match;
      if (std::regex_match(line, match, kInclude)) found.push_back({file.lexically_relative(kRoot), match[1]});
    }
  }
  return found;
}

std::string first_folder(const fs::path& path) { return path.begin()->string(); }

/// What each library may include beside itself: core <- {config, physics, world} <- {detector, response} <- radiation
/// <- {search, flight} <- nodes <- bus; team, mavlink and picture hang on core; sim and report are leaves.
std::map<std::string, std::set<std::string>> allowed_libraries() {
  const std::set<std::string> low = {"core", "config", "physics", "world"};
  const auto with = [](std::set<std::string> set, const std::set<std::string>& more) {
    set.insert(more.begin(), more.end());
    return set;
  };
  std::map<std::string, std::set<std::string>> allowed;
  allowed["core"] = {};
  for (const std::string library : {"config", "physics", "world", "team", "mavlink", "picture"})
    allowed[library] = {"core"};
  allowed["detector"] = low;
  allowed["response"] = with(low, {"detector"});
  allowed["radiation"] = with(low, {"detector", "response"});
  allowed["flight"] = with(allowed["radiation"], {"radiation"});
  allowed["search"] = with(allowed["flight"], {"flight"});
  allowed["nodes"] = with(allowed["search"], {"search", "team", "mavlink"});
  allowed["bus"] = with(allowed["nodes"], {"nodes"});
  allowed["sim"] = allowed["report"] = with(allowed["bus"], {"bus"});
  return allowed;
}

TEST(Layering, EachLibraryIncludesOnlyWhatIsBelowIt) {
  const auto allowed = allowed_libraries();
  int checked = 0;
  for (const auto& [file, what] : includes({"lib"})) {
    const std::string from = std::next(file.begin())->string(), to = first_folder(what);
    ASSERT_TRUE(allowed.contains(from)) << file << " is in a library that no layer names";
    if (!allowed.contains(to) || to == from) continue;
    ++checked;
    EXPECT_TRUE(allowed.at(from).contains(to)) << file << " includes " << what << ", which is not below " << from;
  }
  EXPECT_GT(checked, 20) << "the includes were not found";
}

TEST(Layering, EachForeignLibraryHasOneUser) {
  struct Rule {
    std::string prefix;
    std::vector<std::string> users;  // beginnings of paths
  };
  const std::vector<Rule> rules = {{"lcm/", {"lib/bus/"}},         {"comptonaut/msg/", {"lib/bus/"}},
                                   {"yaml-cpp/", {"lib/config/"}}, {"octomap/", {"lib/world/"}},
                                   {"ccd/", {"lib/flight/"}},      {"cairo/", {"lib/picture/"}},
                                   {"png.h", {"lib/world/"}},      {"CLI/", {"lib/bus/daemon.cpp", "daemons/"}}};
  for (const Rule& rule : rules) {
    int used = 0;
    for (const auto& [file, what] : includes({"lib", "daemons"})) {
      if (!what.starts_with(rule.prefix)) continue;
      ++used;
      const bool may = std::any_of(rule.users.begin(), rule.users.end(),
                                   [&](const std::string& user) { return file.string().starts_with(user); });
      EXPECT_TRUE(may) << file << " includes " << what;
    }
    EXPECT_GT(used, 0) << rule.prefix << " is used nowhere: does the rule still name it right?";
  }
}

TEST(Layering, ADaemonsMainIsATableOfContents) {
  int mains = 0;
  for (const fs::path& file : sources({"daemons"})) {
    if (file.filename() != "main.cpp") continue;
    ++mains;
    EXPECT_LT(lines_of(file).size(), 60u) << file;
  }
  EXPECT_GT(mains, 1);
}

TEST(Layering, NoFileGrowsPastThreeHundredLines) {
  for (const fs::path& file : sources({"lib", "daemons", "tests"})) EXPECT_LE(lines_of(file).size(), 300u) << file;
}

TEST(Layering, EveryHeaderGuardsItself) {
  for (const fs::path& file : files_below({"lib", "daemons", "tests"}, {".h"})) {
    const auto lines = lines_of(file);
    EXPECT_NE(std::find(lines.begin(), lines.end(), "#pragma once"), lines.end()) << file;
  }
}

TEST(Layering, EveryFileBeginsWithItsLicence) {
  const std::string kLicence = "SPDX-License-Identifier: BSD-3-Clause";
  const std::set<std::string> kExtensions = {".h",      ".cpp",   ".lcm",           ".sh", ".py", ".yaml", ".service",
                                             ".target", ".cmake", "CMakeLists.txt", ".js", ".css"};
  auto files = files_below({"lib", "daemons", "tests", "lcmtypes", "config", "scripts", "systemd", ".ci"}, kExtensions);
  files.push_back(kRoot / "CMakeLists.txt");
  for (const fs::path& file : files) {
    const auto lines = lines_of(file);
    const std::size_t first = !lines.empty() && lines[0].starts_with("#!") ? 1 : 0;
    ASSERT_GT(lines.size(), first) << file;
    EXPECT_NE(lines[first].find(kLicence), std::string::npos) << file << ": " << lines[first];
  }
}

}  // namespace
}  // namespace comptonaut
