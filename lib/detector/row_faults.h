// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace comptonaut {

/// Why a row of hit data was left out.
enum class RowFault {
  kNotSixNumbers,
  kNonAscii,
  kTooLong,
  kCutShort,       ///< last line or record without its end
  kPixel,          ///< not on the matrix of 256 x 256
  kToA,            ///< arrival time beyond 40 days, or outside its frame
  kFToA,           ///< above 31
  kToT,            ///< above 1023
  kZeroToT,        ///< chip error
  kMarker,         ///< an Overflow row that is not known, or a gap without its beginning
  kOutOfSequence,  ///< one or two rows that jump in time where all others go on
  kLate,           ///< came after its time had been closed
  kNoTimeBase,     ///< nothing tells what UTC the stream's time 0 was
  kNotACluster,    ///< of a cluster log: neither a frame nor a cluster
  kNoFrame,        ///< of a cluster log: a cluster before any frame
  kEnergy,         ///< of a cluster log: below 1 eV or above 1 GeV
};
inline constexpr std::size_t kRowFaults = 16;

/// "rows_zero_tot" and the like, for counters.
[[nodiscard]] std::string_view counter_name(RowFault fault);
/// What was wrong, for people.
[[nodiscard]] std::string_view describe(RowFault fault);
/// Such a row may have told of a photon. One of ToT 0 never does, a marker tells of something else.
[[nodiscard]] constexpr bool loses_hit(RowFault fault) {
  return fault != RowFault::kZeroToT && fault != RowFault::kMarker && fault != RowFault::kNoTimeBase;
}

/// Rows left out, by kind, and where the first of each kind stood.
struct RowFaults {
  std::array<std::int64_t, kRowFaults> count{};
  std::array<std::int64_t, kRowFaults> first_line{};  ///< from 1, of binary data the record; 0: none, or not known

  void add(RowFault fault, std::int64_t line) {
    const auto i = static_cast<std::size_t>(fault);
    if (count[i]++ == 0) first_line[i] = line;
  }
  /// The latest fault, at `line`, turns out to be another one.
  void move(RowFault from, RowFault to, std::int64_t line);
  [[nodiscard]] std::int64_t of(RowFault fault) const { return count[static_cast<std::size_t>(fault)]; }
  [[nodiscard]] std::int64_t total() const;
  [[nodiscard]] std::int64_t hits_lost() const;  ///< those of the kinds of which loses_hit
  /// Those of what came later: the first of a kind stays the first.
  RowFaults& operator+=(const RowFaults& later);
};

}  // namespace comptonaut
