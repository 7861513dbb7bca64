// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/mav_channel.h"

#include <fmt/format.h>

#include <charconv>

namespace comptonaut {

std::string mav_channel(int mav, std::string_view name) { return fmt::format("MAV{}_{}", mav, name); }

std::optional<MavChannel> parse_mav_channel(std::string_view channel) {
  constexpr std::string_view kPrefix = "MAV";
  if (!channel.starts_with(kPrefix)) return {};
  MavChannel parts;
  const char* const end = channel.data() + channel.size();
  const auto [rest, error] = std::from_chars(channel.data() + kPrefix.size(), end, parts.mav);
  if (error != std::errc{} || parts.mav < 0 || parts.mav > kMaxMav || rest == end || *rest != '_') return {};
  parts.name = std::string_view(rest + 1, static_cast<std::size_t>(end - rest - 1));
  return parts;
}

int mav_of_channel(std::string_view channel) {
  const auto parts = parse_mav_channel(channel);
  return parts ? parts->mav : -1;
}

}  // namespace comptonaut
