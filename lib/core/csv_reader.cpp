// SPDX-License-Identifier: BSD-3-Clause
#include "core/csv_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "core/text.h"

namespace comptonaut {
namespace {

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

template <class T>
std::optional<T> parsed(std::string_view text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

/// As much of a field as a message has room for, without what would disturb a terminal.
std::string shown(std::string_view text) {
  constexpr std::size_t kRoom = 40;
  std::string clean(text.substr(0, kRoom));
  for (char& c : clean) c = static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
  return clean + (text.size() > kRoom ? "..." : "");
}

}  // namespace

CsvReader::CsvReader(const std::filesystem::path& file, std::vector<std::string> columns)
    : file_(file.string()), in_(file, std::ios::binary), columns_(std::move(columns)) {
  if (!in_ || !std::filesystem::is_regular_file(file)) {
    throw std::runtime_error(fmt::format("{}: cannot be read, must be a CSV file", file_));
  }
  read_header();
}

bool CsvReader::next() {
  if (!read_line()) return false;
  split();
  if (fields_.size() == columns_.size()) return true;
  throw error(fmt::format("{} fields, must be {}: {}", fields_.size(), columns_.size(), fmt::join(columns_, ",")));
}

double CsvReader::number(std::size_t column, double min, double max) const {
  const auto value = parsed<double>(field(column));
  if (value && *value >= min && *value <= max) return *value;  // false for NaN
  throw error(column, fmt::format("a number from {:.6g} to {:.6g}", min, max));
}

std::int64_t CsvReader::whole(std::size_t column, std::int64_t min, std::int64_t max) const {
  const auto value = parsed<std::int64_t>(field(column));
  if (value && *value >= min && *value <= max) return *value;
  throw error(column, fmt::format("a whole number from {} to {}", min, max));
}

std::runtime_error CsvReader::error(const std::string& what) const {
  return std::runtime_error(fmt::format("{}:{}: {}", file_, line_, what));
}

std::runtime_error CsvReader::error(std::size_t column, const std::string& must_be) const {
  return error(fmt::format("{} '{}': must be {}", columns_[column], shown(field(column)), must_be));
}

/// The next line that says something.
bool CsvReader::read_line() {
  while (std::getline(in_, text_)) {
    if (++line_ == 1 && text_.starts_with(kByteOrderMark)) text_.erase(0, kByteOrderMark.size());
    const std::string_view line = trimmed(text_);
    if (!line.empty() && !line.starts_with('#')) return true;
  }
  return false;
}

void CsvReader::split() {
  fields_.clear();
  std::string_view rest = text_;
  for (auto comma = rest.find(','); comma != rest.npos; comma = rest.find(',')) {
    fields_.push_back(trimmed(rest.substr(0, comma)));
    rest.remove_prefix(comma + 1);
  }
  fields_.push_back(trimmed(rest));
}

void CsvReader::read_header() {
  const std::string wanted = fmt::format("must begin with the header {}", fmt::join(columns_, ","));
  if (!read_line()) throw std::runtime_error(fmt::format("{}: is empty, {}", file_, wanted));
  split();
  for (const std::string_view name : fields_) {
    if (std::find(columns_.begin(), columns_.end(), name) == columns_.end()) {
      throw error(fmt::format("'{}' is no column of it, {}", shown(name), wanted));
    }
    if (std::count(fields_.begin(), fields_.end(), name) > 1) throw error(fmt::format("'{}' stands twice", name));
  }
  for (const std::string& column : columns_) {
    const auto at = std::find(fields_.begin(), fields_.end(), column);
    if (at == fields_.end()) throw error(fmt::format("column '{}' is missing, {}", column, wanted));
    field_of_.push_back(static_cast<std::size_t>(at - fields_.begin()));
  }
}

}  // namespace comptonaut
