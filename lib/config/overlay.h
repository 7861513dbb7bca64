// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace comptonaut {

/// One value that is to stand in a configuration: keys from the outermost mapping on, and the value as YAML text.
struct ConfigOverride {
  std::vector<std::string> keys;
  std::string value;
};

/// The text of a YAML file with some values put in place of its own, comments left out. Throws ConfigError where the
/// file cannot be read or a key stands below something that is no mapping.
[[nodiscard]] std::string overlaid(const std::filesystem::path& file, const std::vector<ConfigOverride>& overrides);

}  // namespace comptonaut
