// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/team_link_config.h"

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>
#include <utility>

#include "config/config.h"
#include "nodes/mav_channel.h"

namespace comptonaut {
namespace {

bool is_name(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  });
}

std::vector<ChannelRule> read_rules(Config& config, const std::string& key) {
  std::vector<std::string> patterns;
  config.require(key, patterns);
  try {
    return {patterns.begin(), patterns.end()};
  } catch (const std::invalid_argument& e) {
    throw config.error(key, e.what());
  }
}

ForwardRules read_forward_rules(Config& config) {
  return {.out = read_rules(config, "out"), .in = read_rules(config, "in")};
}

}  // namespace

ChannelRule::ChannelRule(const std::string& pattern) : name_(pattern) {
  const std::array<std::pair<std::string, Whose>, 3> prefixes = {
      {{"MAV{own}_", Whose::own}, {"MAV{others}_", Whose::others}, {"MAV{any}_", Whose::any}}};
  for (const auto& [prefix, whose] : prefixes) {
    if (!pattern.starts_with(prefix)) continue;
    whose_ = whose;
    name_ = pattern.substr(prefix.size());
  }
  if (pattern == "*") {
    whose_ = Whose::all;
  } else if (!is_name(name_)) {
    throw std::invalid_argument("'" + pattern +
                                "' is not a channel: expected MAV{own}_X, MAV{others}_X, MAV{any}_X, X or *");
  }
}

bool ChannelRule::matches(const std::string& channel, int own_mav) const {
  if (whose_ == Whose::all) return true;
  if (whose_ == Whose::nobody) return channel == name_;
  const auto parts = parse_mav_channel(channel);
  if (!parts || parts->name != name_) return false;
  return whose_ == Whose::any || (whose_ == Whose::own) == (parts->mav == own_mav);
}

TeamLinkConfig read_team_link_config(Config& config) {
  TeamLinkConfig link;
  config.read("team_url", link.team_url);
  config.read("pose_rate_hz", link.pose_rate_hz, {.min = 0.1, .max = 1000.0});
  config.read("pose_quality_rate_hz", link.pose_quality_rate_hz, {.min = 0.1, .max = 1000.0});
  config.section("drone", [&](Config& section) { link.drone = read_forward_rules(section); });
  config.section("ground", [&](Config& section) { link.ground = read_forward_rules(section); });
  return link;
}

}  // namespace comptonaut
