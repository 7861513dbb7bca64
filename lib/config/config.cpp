// SPDX-License-Identifier: BSD-3-Clause
#include "config/config.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>
#include <set>
#include <type_traits>

namespace comptonaut {

struct Config::Node {
  Node(YAML::Node mapping, std::filesystem::path read_from, std::string place)
      : yaml(std::move(mapping)), file(std::move(read_from)), prefix(std::move(place)) {}

  YAML::Node yaml;
  std::filesystem::path file;
  std::string prefix;  ///< "detector." inside a section
  mutable std::set<std::string> known;

  [[nodiscard]] std::optional<YAML::Node> find(const std::string& key) const {
    known.insert(key);
    const YAML::Node& mapping = yaml;  // const: looking must not insert
    const YAML::Node value = mapping[key];
    return value.IsDefined() ? std::optional(value) : std::nullopt;
  }
};

namespace {

std::string place(const std::filesystem::path& file, const YAML::Mark& mark) {
  return mark.is_null() ? file.string() : fmt::format("{}:{}", file.string(), mark.line + 1);
}

std::string shown(const YAML::Node& value) {
  if (value.IsScalar()) return fmt::format("'{}'", value.Scalar());
  return value.IsMap() ? "a mapping" : value.IsSequence() ? "a list" : "nothing";
}

std::string shown(Range range) {
  if (std::isinf(range.max) && std::isinf(range.min)) return "a finite number";
  if (std::isinf(range.max)) return fmt::format("at least {}", range.min);
  if (std::isinf(range.min)) return fmt::format("at most {}", range.max);
  return fmt::format("{} to {}", range.min, range.max);
}

/// The value as a number within the range, or nullopt.
template <class T>
std::optional<T> number(const YAML::Node& value, Range range) {
  T result{};
  if (!value.IsScalar() || !YAML::convert<T>::decode(value, result)) return std::nullopt;
  const auto as_double = static_cast<double>(result);
  const bool valid = std::isfinite(as_double) && as_double >= range.min && as_double <= range.max;
  return valid ? std::optional(result) : std::nullopt;
}

template <class T>
std::string kind(Range range) {
  return std::is_integral_v<T> ? fmt::format("a whole number, {}", shown(range)) : shown(range);
}

}  // namespace

Config::Config(std::unique_ptr<Node> node) : node_(std::move(node)) {}
Config::~Config() = default;

ConfigError Config::error(const std::string& key, const std::string& what) const {
  const auto value = node_->find(key);
  return ConfigError(fmt::format("{}: {}{}: {}", place(node_->file, value ? value->Mark() : node_->yaml.Mark()),
                                 node_->prefix, key, what));
}

template <class T>
void Config::read_number(const std::string& key, T& value, Range range) {
  const auto node = node_->find(key);
  if (!node) return;
  const auto result = number<T>(*node, range);
  if (!result) throw error(key, fmt::format("{} is not allowed, must be {}", shown(*node), kind<T>(range)));
  value = *result;
}

template <class T>
void Config::read_numbers(const std::string& key, std::vector<T>& value, Range range) {
  const auto node = node_->find(key);
  if (!node) return;
  if (!node->IsSequence()) throw error(key, fmt::format("{} is not allowed, must be a list of numbers", shown(*node)));
  std::vector<T> result;
  for (const YAML::Node& element : *node) {
    const auto one = number<T>(element, range);
    if (!one) throw error(key, fmt::format("{} is not allowed, each must be {}", shown(element), kind<T>(range)));
    result.push_back(*one);
  }
  value = std::move(result);
}

void Config::read(const std::string& key, double& value, Range range) { read_number(key, value, range); }
void Config::read(const std::string& key, int& value, Range range) { read_number(key, value, range); }
void Config::read(const std::string& key, std::int64_t& value, Range range) { read_number(key, value, range); }
void Config::read(const std::string& key, std::vector<double>& value, Range range) { read_numbers(key, value, range); }
void Config::read(const std::string& key, std::vector<int>& value, Range range) { read_numbers(key, value, range); }

void Config::read(const std::string& key, bool& value) {
  const auto node = node_->find(key);
  if (!node) return;
  if (!node->IsScalar() || !YAML::convert<bool>::decode(*node, value)) {
    throw error(key, fmt::format("{} is not allowed, must be true or false", shown(*node)));
  }
}

void Config::read(const std::string& key, std::string& value) {
  const auto node = node_->find(key);
  if (!node) return;
  if (!node->IsScalar()) throw error(key, fmt::format("{} is not allowed, must be a text", shown(*node)));
  value = node->Scalar();
}

void Config::read(const std::string& key, std::string& value, const std::vector<std::string>& allowed) {
  std::string result = value;
  read(key, result);
  if (std::find(allowed.begin(), allowed.end(), result) == allowed.end()) {
    throw error(key, fmt::format("'{}' is not allowed, must be one of: {}", result, fmt::join(allowed, ", ")));
  }
  value = result;
}

void Config::read(const std::string& key, Eigen::Vector3d& value, Range range) {
  std::vector<double> elements(value.begin(), value.end());
  read(key, elements, range);
  if (elements.size() != 3) throw error(key, fmt::format("{} numbers, must be three: x, y, z", elements.size()));
  value = Eigen::Vector3d(elements[0], elements[1], elements[2]);
}

void Config::read(const std::string& key, std::vector<std::string>& value) {
  const auto node = node_->find(key);
  if (!node) return;
  const bool texts = node->IsSequence() && std::all_of(node->begin(), node->end(),
                                                       [](const YAML::Node& element) { return element.IsScalar(); });
  if (!texts) throw error(key, fmt::format("{} is not allowed, must be a list of texts", shown(*node)));
  value.clear();
  for (const YAML::Node& element : *node) value.push_back(element.Scalar());
}

void Config::read(const std::string& key, std::filesystem::path& value) {
  std::string text;
  read(key, text);
  if (!text.empty()) value = node_->file.parent_path() / text;
}

bool Config::has(const std::string& key) const { return node_->find(key).has_value(); }

void Config::must_have(const std::string& key) const {
  if (!node_->find(key)) throw error(key, "is missing");
}

void Config::section(const std::string& key, const Reader& reader) {
  const auto node = node_->find(key);
  if (!node) return;
  if (!node->IsMap()) throw error(key, fmt::format("{} is not allowed, must be a mapping", shown(*node)));
  run(std::make_unique<Node>(*node, node_->file, node_->prefix + key + "."), reader);
}

void Config::each(const std::string& key, const Reader& reader) {
  const auto node = node_->find(key);
  if (!node) return;
  if (!node->IsSequence()) throw error(key, fmt::format("{} is not allowed, must be a list", shown(*node)));
  for (std::size_t i = 0; i < node->size(); ++i) {
    const YAML::Node element = (*node)[i];
    if (!element.IsMap()) throw error(key, fmt::format("{} is not allowed, each must be a mapping", shown(element)));
    run(std::make_unique<Node>(element, node_->file, fmt::format("{}{}[{}].", node_->prefix, key, i)), reader);
  }
}

void Config::refuse_unknown_keys() const {
  std::set<std::string> seen;
  for (const auto& entry : node_->yaml) {
    const std::string key = entry.first.Scalar();
    const std::string where = fmt::format("{}: {}{}", place(node_->file, entry.first.Mark()), node_->prefix, key);
    if (!node_->known.contains(key)) {
      throw ConfigError(fmt::format("{}: unknown key, known here: {}", where, fmt::join(node_->known, ", ")));
    }
    if (!seen.insert(key).second) throw ConfigError(fmt::format("{}: stands twice", where));
  }
}

void Config::run(std::unique_ptr<Node> node, const Reader& reader) {
  Config config(std::move(node));
  reader(config);
  config.refuse_unknown_keys();
}

void Config::read_file(const std::filesystem::path& file, const Reader& reader) {
  std::ifstream stream(file);
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  if (!std::filesystem::is_regular_file(file) || !stream) {
    throw ConfigError(fmt::format("{}: cannot be read, must be a YAML file", file.string()));
  }
  // What a power cut leaves of a file that was being written. Defaults alone need at least a comment.
  if (text.empty()) throw ConfigError(fmt::format("{}: is empty, must hold keys or a comment", file.string()));
  read_text(text, file, reader);
}

void Config::read_text(const std::string& text, const std::filesystem::path& name, const Reader& reader) {
  YAML::Node root;
  try {
    root = YAML::Load(text);
  } catch (const YAML::Exception& e) {
    throw ConfigError(fmt::format("{}: not YAML: {}", place(name, e.mark), e.msg));
  }
  if (root.IsNull()) root = YAML::Node(YAML::NodeType::Map);
  if (!root.IsMap())
    throw ConfigError(fmt::format("{}: {} is not allowed, must be a mapping", name.string(), shown(root)));
  run(std::make_unique<Node>(root, name, ""), reader);
}

}  // namespace comptonaut
