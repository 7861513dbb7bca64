// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "core/angle.h"
#include "response/cone_density.h"

namespace comptonaut {
namespace {

std::string header() {
  std::string text = "readings,beta_rad,pairs";
  for (std::size_t i = 0; i < kConeParts; ++i) {
    const double sigma_deg = cone_sigmas_rad()[i] / kDegree;
    text += std::isfinite(sigma_deg) ? fmt::format(",{}_{:.1f}_deg", i < kConeRings ? "ring" : "disc", sigma_deg)
                                     : ",isotropic";
  }
  return text;
}

std::string_view without_blanks(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r";
  const auto first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

/// The numbers of a row after its first field.
std::optional<ConeDensity::Node> parse_node(std::string_view fields) {
  std::array<double, 2 + kConeParts> values{};
  const char* at = fields.data();
  const char* const end = at + fields.size();
  for (double& value : values) {
    if (at == end || *at != ',') return std::nullopt;
    const auto [next, error] = std::from_chars(at + 1, end, value);
    if (error != std::errc{}) return std::nullopt;
    at = next;
  }
  if (at != end) return std::nullopt;
  ConeDensity::Node node{.beta_rad = values[0], .pairs = values[1]};
  std::copy(values.begin() + 2, values.end(), node.weights.begin());
  return node;
}

std::string rows(const std::vector<ConeDensity::Node>& nodes, const char* readings) {
  std::string text;
  for (const ConeDensity::Node& node : nodes) {
    text += fmt::format("{},{},{}", readings, node.beta_rad, node.pairs);
    for (const double weight : node.weights) text += fmt::format(",{:.8g}", weight);
    text += '\n';
  }
  return text;
}

}  // namespace

ConeDensity ConeDensity::load(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error(fmt::format("{}: cannot be read, must be a cone density", file.string()));
  std::vector<Node> both, sole;
  Facts facts;
  bool header_seen = false;
  int line_number = 0;
  const auto refuse = [&](const std::string& what) {
    throw std::runtime_error(fmt::format("{}:{}: {}", file.string(), line_number, what));
  };
  for (std::string line; std::getline(in, line);) {
    ++line_number;
    const std::string_view text = without_blanks(line);
    if (text.empty()) continue;
    if (text.starts_with('#')) {
      const auto colon = text.find(": ");
      if (colon != std::string_view::npos)
        facts.emplace(without_blanks(text.substr(1, colon - 1)), without_blanks(text.substr(colon + 1)));
    } else if (!header_seen) {
      header_seen = text == header();
      if (!header_seen) refuse(fmt::format("expected '{}'", header()));
    } else {
      const auto comma = std::min(text.find(','), text.size());
      const std::string_view readings = text.substr(0, comma);
      const auto node = parse_node(text.substr(comma));
      if (!node || (readings != "both" && readings != "sole")) {
        refuse(fmt::format("must be 'both' or 'sole' and {} numbers, between commas", 2 + kConeParts));
      }
      (readings == "both" ? both : sole).push_back(*node);
    }
  }
  try {
    return ConeDensity(std::move(both), std::move(sole), std::move(facts));
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(fmt::format("{}: {}", file.string(), error.what()));
  }
}

void ConeDensity::save(const std::filesystem::path& file) const {
  std::string text;
  for (const auto& [key, value] : facts_) text += fmt::format("# {}: {}\n", key, value);
  text += header() + '\n' + rows(both_, "both") + rows(sole_, "sole");
  std::ofstream out(file, std::ios::binary);
  out << text << std::flush;
  if (!out) throw std::runtime_error(fmt::format("{}: cannot be written", file.string()));
}

}  // namespace comptonaut
