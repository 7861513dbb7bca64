// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/text.h"

namespace comptonaut {

/// What is wrong with a configuration: one line with file, line, key, value and what would be right.
class ConfigError : public std::runtime_error {
 public:
  explicit ConfigError(const std::string& what) : std::runtime_error(one_line(what)) {}
};

/// Values that a number may have, both ends included.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
};

/// One mapping of a YAML file, read strictly: a key that nobody reads, a value of the wrong type or out of its range
/// is a ConfigError. Defaults live in the structs that are filled: `read` leaves a value alone where its key is
/// absent, `require` does not accept absence.
///
///   MapperConfig read_mapper_config(Config& config) {
///     MapperConfig mapper;
///     config.read("pose_wait_s", mapper.pose_wait_s, {.min = 0.0, .max = 10.0});
///     config.section("extrinsics", [&](Config& section) { section.require("p_BD_m", mapper.p_BD_m); });
///     return mapper;
///   }
///   const auto mapper = load_config(path, read_mapper_config);
class Config {
 public:
  using Reader = std::function<void(Config&)>;

  void read(const std::string& key, double& value, Range range = {});
  void read(const std::string& key, int& value, Range range = {});
  void read(const std::string& key, std::int64_t& value, Range range = {});
  void read(const std::string& key, bool& value);
  void read(const std::string& key, std::string& value);
  void read(const std::string& key, std::string& value, const std::vector<std::string>& allowed);
  void read(const std::string& key, Eigen::Vector3d& value, Range range = {});
  void read(const std::string& key, std::vector<double>& value, Range range = {});
  void read(const std::string& key, std::vector<int>& value, Range range = {});
  void read(const std::string& key, std::vector<std::string>& value);
  /// A path relative to the folder of the configuration file; stays empty where the key is absent.
  void read(const std::string& key, std::filesystem::path& value);

  template <class T, class... Limits>
  void require(const std::string& key, T& value, Limits&&... limits) {
    must_have(key);
    read(key, value, std::forward<Limits>(limits)...);
  }

  [[nodiscard]] bool has(const std::string& key) const;

  /// Reads the mapping under `key`; does nothing where it is absent.
  void section(const std::string& key, const Reader& reader);
  /// Reads each mapping of the list under `key`; does nothing where it is absent.
  void each(const std::string& key, const Reader& reader);

  /// A ConfigError that names the file, the line of `key`, and says what is wrong with it.
  [[nodiscard]] ConfigError error(const std::string& key, const std::string& what) const;

  /// For load_config and parse_config.
  static void read_file(const std::filesystem::path& file, const Reader& reader);
  static void read_text(const std::string& text, const std::filesystem::path& name, const Reader& reader);

 private:
  struct Node;
  explicit Config(std::unique_ptr<Node> node);
  ~Config();
  void must_have(const std::string& key) const;
  template <class T>
  void read_number(const std::string& key, T& value, Range range);
  template <class T>
  void read_numbers(const std::string& key, std::vector<T>& value, Range range);
  void refuse_unknown_keys() const;
  static void run(std::unique_ptr<Node> node, const Reader& reader);

  std::unique_ptr<Node> node_;
};

/// What `reader` (a function from Config& to a struct) makes of a file. Throws ConfigError.
template <class F>
[[nodiscard]] auto load_config(const std::filesystem::path& file, F&& reader) {
  decltype(reader(std::declval<Config&>())) result;
  Config::read_file(file, [&](Config& config) { result = reader(config); });
  return result;
}

/// The same for YAML text; `name` stands for the file in messages and in relative paths.
template <class F>
[[nodiscard]] auto parse_config(const std::string& text, const std::filesystem::path& name, F&& reader) {
  decltype(reader(std::declval<Config&>())) result;
  Config::read_text(text, name, [&](Config& config) { result = reader(config); });
  return result;
}

}  // namespace comptonaut
