// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace comptonaut {

/// The highest number of a MAV: MAVLink's system ids go no further.
inline constexpr int kMaxMav = 250;

/// A channel of one machine of the team: {3, "POSE"} is MAV3_POSE; 0 is the ground station.
struct MavChannel {
  int mav = 0;
  std::string_view name;  ///< a view of what it was parsed from
};

[[nodiscard]] std::string mav_channel(int mav, std::string_view name);

/// nullopt where it is no channel of one machine, 0..kMaxMav.
[[nodiscard]] std::optional<MavChannel> parse_mav_channel(std::string_view channel);

/// 3 for "MAV3_EVENTS"; -1 where it is no channel of one machine.
[[nodiscard]] int mav_of_channel(std::string_view channel);

}  // namespace comptonaut
