// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace comptonaut {

/// One value of a YAML file: "area.x_max_m" and "70" for `area: {x_max_m: 70}`.
struct YamlValue {
  std::string key;    ///< mappings on the way to it separated by dots
  std::string value;  ///< YAML: a number, a text, "[1, 2, 3]"
};

/// The YAML text with these values set, whether or not they were there; comments are lost.
/// Throws ConfigError where the text or a value is not YAML, or a key leads through what is not a mapping.
[[nodiscard]] std::string with_values(const std::string& yaml, const std::vector<YamlValue>& values);

}  // namespace comptonaut
