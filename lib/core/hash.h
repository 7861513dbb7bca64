// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstdint>
#include <span>

namespace comptonaut {

/// FNV-1a with 64 bits over the doubles' bytes, lowest first: equal numbers, bit for bit, have equal hashes. `hash` is
/// where an earlier stretch has left off.
[[nodiscard]] constexpr std::uint64_t fnv1a(std::span<const double> values, std::uint64_t hash = 0xcbf29ce484222325) {
  for (const double value : values) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    for (int byte = 0; byte < 8; ++byte) hash = (hash ^ (bits >> (8 * byte) & 0xff)) * 0x100000001b3;
  }
  return hash;
}

}  // namespace comptonaut
