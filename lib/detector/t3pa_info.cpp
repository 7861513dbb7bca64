// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <string_view>

#include "core/text.h"
#include "detector/t3pa.h"

namespace comptonaut {
namespace {

constexpr double kMaxUnix_s = 4'102'444'800.0;  // 2100

/// "Start time" of a line `"Start time" ("Acquisition start time"):`; empty for any other line.
std::string_view quoted_name(std::string_view line) {
  if (!line.starts_with('"')) return {};
  const auto end = line.find('"', 1);
  return end == line.npos ? std::string_view() : line.substr(1, end - 1);
}

}  // namespace

std::optional<T3paInfo> read_t3pa_info(const std::filesystem::path& recording) {
  std::filesystem::path file = recording;
  file += ".info";
  std::ifstream in(file);
  return in ? std::optional(read_t3pa_info(in, file.string())) : std::nullopt;
}

T3paInfo read_t3pa_info(std::istream& in, const std::string& file) {
  T3paInfo info;
  int number = 0;
  for (std::string name, type, value; std::getline(in, name);) {
    ++number;
    const std::string key(quoted_name(trimmed(name)));
    if (key != "Start time" && key != "ChipboardID") continue;
    std::getline(in, type);
    std::getline(in, value);
    number += 2;
    const std::string_view text = trimmed(value);
    if (key == "ChipboardID") {
      info.chip = text;
      continue;
    }
    double unix_s = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), unix_s);
    const bool whole = error == std::errc() && end == text.data() + text.size();
    if (!whole || !(unix_s >= 0.0 && unix_s < kMaxUnix_s)) {
      throw std::runtime_error(
          fmt::format("{}:{}: Start time '{}' must be a Unix time in seconds", file, number, text.substr(0, 40)));
    }
    info.start_utime = std::llround(1e6 * unix_s);
  }
  return info;
}

}  // namespace comptonaut
