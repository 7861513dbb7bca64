// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "detector/row_faults.h"
#include "detector/stream_item.h"

namespace comptonaut {

inline constexpr std::int64_t kMaxToA = std::int64_t{1} << 47;  ///< ticks of 25 ns: 40 days
inline constexpr std::int64_t kUnitsPerTick = 16;               ///< of chip time

/// The numbers of a row of .t3pa or a record of .t3p, none of them negative.
struct HitRow {
  std::int64_t index = 0;
  std::int64_t pixel = 0;
  std::int64_t toa = 0;
  std::int64_t tot = 0;
  std::int64_t ftoa = 0;
  std::int64_t overflow = 0;
};

/// Overflow = 1 marks a gap in the data instead of a hit. Its index opens or closes the gap; closing, ToA is its
/// length.
inline constexpr std::int64_t kGapBegins = 0x74;
inline constexpr std::int64_t kGapEnds = 0x75;

/// Why the row can be no hit and no gap; nullopt: it is one.
[[nodiscard]] inline std::optional<RowFault> fault_of(const HitRow& row) {
  if (row.pixel >= kChipPixels * kChipPixels) return RowFault::kPixel;
  if (row.toa > kMaxToA) return RowFault::kToA;
  if (row.overflow != 0) {
    const bool known = row.overflow == 1 && (row.pixel == kGapBegins || row.pixel == kGapEnds);
    return known ? std::nullopt : std::optional(RowFault::kMarker);
  }
  if (row.ftoa > 31) return RowFault::kFToA;
  if (row.tot > 1023) return RowFault::kToT;
  if (row.tot == 0) return RowFault::kZeroToT;
  return std::nullopt;
}

/// What a row without fault says.
[[nodiscard]] inline StreamItem item_of(const HitRow& row, std::int64_t line) {
  if (row.overflow != 0) {
    return {.value = kUnitsPerTick * row.toa,
            .line = static_cast<std::uint32_t>(line),
            .kind = row.pixel == kGapBegins ? StreamItem::Kind::kLostBegin : StreamItem::Kind::kLostEnd};
  }
  return {.value = kUnitsPerTick * row.toa - row.ftoa,
          .line = static_cast<std::uint32_t>(line),
          .index = static_cast<std::uint32_t>(row.index),
          .pixel = static_cast<std::uint16_t>(row.pixel),
          .tot = static_cast<std::uint16_t>(row.tot)};
}

}  // namespace comptonaut
