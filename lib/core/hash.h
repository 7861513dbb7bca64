// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <string_view>

namespace comptonaut {

/// FNV-1a with 64 bits [Fowler, Noll, Vo].
class Fnv1a {
 public:
  constexpr void add(std::uint8_t byte) { value_ = (value_ ^ byte) * 0x100000001b3; }
  /// Its bytes, lowest first: equal numbers, bit for bit, have equal hashes.
  constexpr void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
  constexpr void add(std::uint64_t number) {
    for (int shift = 0; shift < 64; shift += 8) add(static_cast<std::uint8_t>(number >> shift));
  }
  constexpr void add(std::string_view bytes) {
    for (const char byte : bytes) add(static_cast<std::uint8_t>(byte));
  }
  [[nodiscard]] constexpr std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325;
};

[[nodiscard]] constexpr std::uint64_t fnv1a(std::span<const double> values) {
  Fnv1a hash;
  for (const double value : values) hash.add(value);
  return hash.value();
}

}  // namespace comptonaut
