// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "mavlink/messages.h"

namespace comptonaut {

/// Who speaks: system id (here the MAV's number) and component id.
struct MavlinkAddress {
  std::uint8_t system = 0;
  std::uint8_t component = 0;

  auto operator<=>(const MavlinkAddress&) const = default;
};

inline constexpr std::uint8_t kComponentAutopilot = 1;
inline constexpr std::uint8_t kComponentOnboardComputer = 191;

/// One MAVLink 2 frame, unsigned, with trailing zeros of the payload cut as the specification asks.
[[nodiscard]] std::vector<std::uint8_t> mavlink_frame(const MavlinkMessage& message, MavlinkAddress from,
                                                      std::uint8_t sequence);

struct ReceivedMavlink {
  MavlinkAddress from;
  std::uint8_t sequence = 0;
  MavlinkMessage message;
};

struct MavlinkCounters {
  std::int64_t messages = 0;       ///< of known kind, checksum right
  std::int64_t unknown = 0;        ///< frames of another kind, left out
  std::int64_t bad_checksum = 0;   ///< places that looked like a frame of known kind
  std::int64_t incompatible = 0;   ///< frames with flags that this parser does not know, left out
  std::int64_t skipped_bytes = 0;  ///< between frames
  std::int64_t lost = 0;           ///< by the gaps in sequence numbers
};

/// Finds MAVLink 2 frames in bytes as they come, cut anywhere. After garbage or a bad checksum it goes on at the next
/// start byte, so no good frame is lost by a bad one before it. Signed frames are taken as if they were not signed:
/// the link is a wire or a loopback socket. Never throws, keeps less than one frame (280 bytes).
class MavlinkParser {
 public:
  std::vector<ReceivedMavlink> on_bytes(std::span<const std::uint8_t> bytes);
  [[nodiscard]] const MavlinkCounters& counters() const { return counters_; }

 private:
  std::size_t take_frame(std::span<const std::uint8_t> bytes, std::vector<ReceivedMavlink>& received);
  std::size_t skip_start_byte();
  void count_sequence(MavlinkAddress from, std::uint8_t sequence);

  std::vector<std::uint8_t> pending_;
  std::map<MavlinkAddress, std::uint8_t> last_sequence_;
  MavlinkCounters counters_;
};

/// CRC-16/MCRF4XX, continued from `crc`.
[[nodiscard]] std::uint16_t mavlink_crc(std::span<const std::uint8_t> bytes, std::uint16_t crc = 0xFFFF);

}  // namespace comptonaut
