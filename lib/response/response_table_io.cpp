// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <array>
#include <charconv>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "core/text.h"
#include "response/response_table.h"

namespace comptonaut {
namespace {

constexpr std::string_view kHeader = "phi_rad,theta_rad,single,single_rel_sigma,pair,pair_rel_sigma";

/// Six numbers between commas.
std::optional<ResponseEntry> parse_row(std::string_view row) {
  std::array<double, 6> values{};
  const char* at = row.data();
  const char* const end = row.data() + row.size();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto [next, error] = std::from_chars(at, end, values[i]);
    const bool last = i + 1 == values.size();
    if (error != std::errc{} || (last ? next != end : next == end || *next != ',')) return std::nullopt;
    at = next + (last ? 0 : 1);
  }
  return ResponseEntry{values[0], values[1], values[2], values[3], values[4], values[5]};
}

}  // namespace

ResponseTable ResponseTable::load(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error(fmt::format("{}: cannot be read, must be a response table", file.string()));
  std::vector<ResponseEntry> entries;
  Facts facts;
  bool header_seen = false;
  int line_number = 0;
  for (std::string line; std::getline(in, line);) {
    ++line_number;
    const std::string_view text = trimmed(line);
    const auto colon = text.find(": ");
    if (text.empty()) continue;
    if (text.starts_with('#')) {
      if (colon != std::string_view::npos)
        facts.emplace(trimmed(text.substr(1, colon - 1)), trimmed(text.substr(colon + 1)));
    } else if (!header_seen) {
      header_seen = text == kHeader;
      if (!header_seen)
        throw std::runtime_error(fmt::format("{}:{}: expected '{}'", file.string(), line_number, kHeader));
    } else if (const auto entry = parse_row(text)) {
      entries.push_back(*entry);
    } else {
      throw std::runtime_error(fmt::format("{}:{}: not six numbers between commas", file.string(), line_number));
    }
  }
  try {
    return ResponseTable(std::move(entries), std::move(facts));
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(fmt::format("{}: {}", file.string(), error.what()));
  }
}

void ResponseTable::save(const std::filesystem::path& file) const {
  std::string text;
  for (const auto& [key, value] : facts_) text += fmt::format("# {}: {}\n", key, value);
  text += fmt::format("{}\n", kHeader);
  for (const ResponseEntry& e : entries_) {
    text += fmt::format("{},{},{},{},{},{}\n", e.phi_rad, e.theta_rad, e.single, e.single_rel_sigma, e.pair,
                        e.pair_rel_sigma);
  }
  std::ofstream out(file, std::ios::binary);
  out << text << std::flush;
  if (!out) throw std::runtime_error(fmt::format("{}: cannot be written", file.string()));
}

}  // namespace comptonaut
