// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "mavlink/messages.h"

namespace comptonaut {

/// What identifies a kind of message on the wire.
struct MavlinkKind {
  std::uint32_t id = 0;
  std::uint8_t crc_extra = 0;  ///< checksum of the definition, so that both sides use the same one
};

[[nodiscard]] MavlinkKind kind_of(const MavlinkMessage& message);

/// nullopt: not one of the messages in use.
[[nodiscard]] std::optional<MavlinkKind> kind_with_id(std::uint32_t id);

/// Fields in the order of the wire (by size, largest first; extensions last), little-endian, trailing zeros cut but for
/// the first byte.
[[nodiscard]] std::vector<std::uint8_t> encode_payload(const MavlinkMessage& message);

/// The inverse: what is missing at the end is zero, what is too much belongs to a newer definition and is ignored.
/// nullopt: not one of the messages in use.
[[nodiscard]] std::optional<MavlinkMessage> decode_payload(std::uint32_t id, std::span<const std::uint8_t> payload);

}  // namespace comptonaut
