// SPDX-License-Identifier: BSD-3-Clause
#include "physics/specfile.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <stdexcept>

namespace comptonaut {
namespace {

std::vector<std::string> words(const std::string& line, std::size_t from) {
  std::vector<std::string> result;
  constexpr const char* kBlank = " \t\r";
  for (auto at = line.find_first_not_of(kBlank, from); at != std::string::npos;) {
    const auto end = std::min(line.find_first_of(kBlank, at), line.size());
    result.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(kBlank, end);
  }
  return result;
}

std::runtime_error malformed(const std::filesystem::path& file, int line, const std::string& what) {
  return std::runtime_error(fmt::format("{}:{}: {}", file.string(), line, what));
}

std::vector<double> numbers(const std::filesystem::path& file, int line, const std::string& text) {
  std::vector<double> result;
  for (const std::string& word : words(text, 0)) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size()) {
      throw malformed(file, line, fmt::format("'{}' is not a number", word));
    }
    result.push_back(value);
  }
  return result;
}

}  // namespace

std::size_t SpecScan::column(std::string_view name) const {
  const auto found = std::find(columns.begin(), columns.end(), name);
  if (found == columns.end()) throw std::runtime_error(fmt::format("{}: no column '{}'", file.string(), name));
  return static_cast<std::size_t>(found - columns.begin());
}

SpecScan read_spec_scan(const std::filesystem::path& file, int number) {
  std::ifstream in(file);
  if (!in) {
    throw std::runtime_error(fmt::format("{}: cannot be read; Debian's package python-fisx-common installs it in {}",
                                         file.string(), kFisxFolder));
  }
  SpecScan scan{.file = file, .columns = {}, .rows = {}};
  const std::string title = fmt::format("#S {} ", number);
  bool inside = false;
  int line_number = 0;
  for (std::string line; std::getline(in, line);) {
    ++line_number;
    if (line.starts_with("#S")) {
      if (inside) break;
      inside = line.starts_with(title);
    } else if (inside && line.starts_with("#L")) {
      scan.columns = words(line, 2);
    } else if (inside && !line.starts_with('#')) {
      std::vector<double> row = numbers(file, line_number, line);
      if (row.empty()) continue;
      if (row.size() != scan.columns.size()) {
        throw malformed(file, line_number, fmt::format("{} numbers, expected {}", row.size(), scan.columns.size()));
      }
      scan.rows.push_back(std::move(row));
    }
  }
  if (scan.rows.empty()) throw std::runtime_error(fmt::format("{}: no data of scan {}", file.string(), number));
  return scan;
}

}  // namespace comptonaut
