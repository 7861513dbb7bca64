// SPDX-License-Identifier: BSD-3-Clause
#include "config/overlay.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "config/config.h"

namespace comptonaut {
namespace {

void put(YAML::Node mapping, const ConfigOverride& entry, std::size_t level, const std::filesystem::path& file) {
  const std::string& key = entry.keys.at(level);
  if (mapping.IsDefined() && !mapping.IsMap() && !mapping.IsNull()) {
    throw ConfigError(fmt::format("{}: {}: stands below something that is no mapping", file.string(), key));
  }
  if (level + 1 == entry.keys.size()) {
    mapping[key] = YAML::Load(entry.value);
  } else {
    put(mapping[key], entry, level + 1, file);
  }
}

}  // namespace

std::string overlaid(const std::filesystem::path& file, const std::vector<ConfigOverride>& overrides) {
  YAML::Node root;
  try {
    root = YAML::LoadFile(file.string());
  } catch (const YAML::Exception& e) {
    throw ConfigError(fmt::format("{}: cannot be read, must be a YAML file ({})", file.string(), e.what()));
  }
  for (const ConfigOverride& entry : overrides) put(root, entry, 0, file);
  return YAML::Dump(root) + "\n";
}

}  // namespace comptonaut
