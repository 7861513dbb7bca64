// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace comptonaut {

/// What names one message on the team bus for ever: the machine, its process, how many it had sent before.
struct TeamNumber {
  std::int32_t sender = 0;      ///< MAV number, 0 for the ground station
  std::int64_t boot_epoch = 0;  ///< start of the sending process, us since the Unix epoch
  std::uint64_t counter = 0;    ///< 0, 1, 2, ... over all channels

  auto operator<=>(const TeamNumber&) const = default;
};

/// The trailer's length. It follows the encoded message, whose decoders ignore it, so that LCM's tools still read what
/// is on the air: sender (4 bytes), boot epoch (8), counter (8), key id (4), tag (32), version (1), zeros (3), magic
/// (4). Version 1 is not authenticated: its key id and its tag are zeros.
inline constexpr std::size_t kTrailerBytes = 64;

void append_trailer(std::vector<std::uint8_t>& message, const TeamNumber& number);

/// A message and the number that its trailer gives it.
struct Numbered {
  TeamNumber number;
  std::span<const std::uint8_t> message;  ///< without the trailer
};

/// nullopt where there is no trailer, one of another version, or one whose numbers cannot be.
[[nodiscard]] std::optional<Numbered> split_trailer(std::span<const std::uint8_t> bytes);

}  // namespace comptonaut
