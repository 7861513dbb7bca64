// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace comptonaut {

template <class Int>
void append_big_endian(std::vector<std::uint8_t>& to, Int value) {
  for (std::size_t i = sizeof(Int); i-- > 0;) {
    to.push_back(static_cast<std::uint8_t>(static_cast<std::uint64_t>(value) >> (8 * i)));
  }
}

/// The first bytes as a number; there must be enough of them.
template <class Int>
[[nodiscard]] Int read_big_endian(std::span<const std::uint8_t> bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < sizeof(Int); ++i) value = value << 8 | bytes[i];
  return static_cast<Int>(value);
}

}  // namespace comptonaut
