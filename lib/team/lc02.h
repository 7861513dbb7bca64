// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace comptonaut {

/// A short message of LCM's UDP multicast: "LC02", sequence number (32 bits, big-endian), channel, a zero, payload.
struct Lc02 {
  std::uint32_t sequence = 0;
  std::string channel;
  std::span<const std::uint8_t> payload;  ///< of the datagram it was read from
};

/// LCM takes no longer channel.
inline constexpr std::size_t kMaxChannelBytes = 63;
/// Beyond it a datagram is not a message of the team bus: LCM's own limit of a short message.
inline constexpr std::size_t kMaxDatagramBytes = 1435;

/// nullopt where the datagram is anything else: LCM's fragments ("LC03"), no channel or one that is too long or has
/// other characters than printable ASCII, more than kMaxDatagramBytes.
[[nodiscard]] std::optional<Lc02> read_lc02(std::span<const std::uint8_t> datagram);

/// Throws std::invalid_argument on what read_lc02 would refuse.
[[nodiscard]] std::vector<std::uint8_t> write_lc02(const Lc02& message);

}  // namespace comptonaut
