// SPDX-License-Identifier: BSD-3-Clause
#include "nuclides.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <stdexcept>

#include "config/config.h"

namespace comptonaut {
namespace {

namespace fs = std::filesystem;

/// Of a program where it was built: the sources' one; of an installed program: the installed one. Empty where there is
/// none.
fs::path folder() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const bool built_here = fs::equivalent(program.parent_path(), COMPTONAUT_BINARY_FOLDER, error);
  const fs::path folder = built_here ? COMPTONAUT_SOURCE_DIR "/config/nuclides" : "/etc/comptonaut/nuclides";
  return fs::is_directory(folder, error) ? folder : fs::path();
}

}  // namespace

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

std::vector<NuclideChannel> known_nuclides() {
  std::vector<NuclideChannel> nuclides;
  const fs::path where = folder();
  if (where.empty()) return nuclides;
  for (const auto& entry : fs::directory_iterator(where)) {
    if (entry.path().extension() == ".yaml") nuclides.push_back(load_config(entry.path(), read_nuclide_channel));
  }
  std::sort(nuclides.begin(), nuclides.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return nuclides;
}

NuclideChannel find_nuclide(const std::string& name_or_file) {
  if (fs::is_regular_file(name_or_file)) return load_config(name_or_file, read_nuclide_channel);
  std::string names;
  for (const NuclideChannel& nuclide : known_nuclides()) {
    if (lower_case(nuclide.name) == lower_case(name_or_file)) return nuclide;
    names += (names.empty() ? "" : ", ") + nuclide.name;
  }
  throw std::runtime_error(fmt::format("--nuclide {}: must be a file such as config/nuclides/cs-137.yaml{}{}",
                                       name_or_file, names.empty() ? "" : ", or one of ", names));
}

}  // namespace comptonaut
