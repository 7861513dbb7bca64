// SPDX-License-Identifier: BSD-3-Clause
#include "config/edit.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "config/config.h"

namespace comptonaut {
namespace {

/// Sets the value below `node` under the part of the key that starts at `begin`.
void set(YAML::Node node, const YamlValue& value, std::size_t begin) {
  if (!node.IsMap()) {
    throw ConfigError(
        fmt::format("cannot set {}: what stands before '{}' is not a mapping", value.key, value.key.substr(begin)));
  }
  const std::size_t dot = value.key.find('.', begin);
  if (dot == std::string::npos) {
    node[value.key.substr(begin)] = YAML::Load(value.value);
    return;
  }
  const std::string name = value.key.substr(begin, dot - begin);
  if (!node[name]) node[name] = YAML::Node(YAML::NodeType::Map);
  set(node[name], value, dot + 1);
}

}  // namespace

std::string with_values(const std::string& yaml, const std::vector<YamlValue>& values) {
  try {
    YAML::Node root = YAML::Load(yaml);
    if (root.IsNull()) root = YAML::Node(YAML::NodeType::Map);
    for (const YamlValue& value : values) set(root, value, 0);
    return YAML::Dump(root) + "\n";
  } catch (const YAML::Exception& error) {
    throw ConfigError(fmt::format("not YAML: {}", error.what()));
  }
}

}  // namespace comptonaut
