// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "detector/hit.h"

namespace comptonaut {

/// Column and row of a pixel, side by side in one number, so that both are compared at once.
using Place = std::uint32_t;
constexpr Place place_of(std::uint16_t pixel) {
  return static_cast<Place>(pixel_y(pixel)) << 16 | static_cast<Place>(pixel_x(pixel));
}
/// Columns and rows from one to the other are -1, 0 or 1: one more than that, and one more than its opposite, are at
/// least 0 and below 4 each.
constexpr bool touch(Place a, Place b) {
  constexpr Place kOnes = 0x0001'0001, kTooLarge = 0xfffc'fffc;
  const Place there = a - b + kOnes, back = b - a + kOnes;
  return ((there | back) & kTooLarge) == 0;
}

inline constexpr std::size_t kMaxHandful = 4;
/// Hits of a handful as a bit each; of all clusters one after another, kMaxHandful bits each, the first at the low end.
using Members = std::uint32_t;

/// Place of a pair of hits, i < j, among all pairs of a handful.
constexpr std::size_t pair_of(std::size_t i, std::size_t j) { return j * (j - 1) / 2 + i; }

/// Clusters of a handful of hits, where a bit says of each pair whether it touches.
constexpr Members members_of(std::uint32_t touching) {
  std::array<std::size_t, kMaxHandful> earliest = {0, 1, 2, 3};  // hit of each one's cluster
  for (std::size_t pass = 0; pass < kMaxHandful; ++pass) {
    for (std::size_t j = 1; j < kMaxHandful; ++j) {
      for (std::size_t i = 0; i < j; ++i) {
        if ((touching >> pair_of(i, j) & 1) != 0) earliest[i] = earliest[j] = std::min(earliest[i], earliest[j]);
      }
    }
  }
  Members members = 0;
  for (std::size_t first = kMaxHandful; first-- > 0;) {
    if (earliest[first] != first) continue;
    members <<= kMaxHandful;
    for (std::size_t i = first; i < kMaxHandful; ++i) members |= (earliest[i] == first ? 1U : 0U) << i;
  }
  return members;
}

inline constexpr auto kMembers = [] {
  std::array<Members, 64> table{};
  for (std::uint32_t touching = 0; touching < table.size(); ++touching) table[touching] = members_of(touching);
  return table;
}();

}  // namespace comptonaut
