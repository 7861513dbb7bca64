// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "detector/hit.h"

namespace comptonaut {

/// The fault: 14 bits of coarse time, 16,384 ticks of 25 ns = 409.6 us.
inline constexpr ChipTime kEpochFault = ChipTime{16} * 16384;

/// A row that lies farther back than this from the newest one is settled.
inline constexpr ChipTime kEpochRepairDelay = 4 * kEpochFault;

/// Repairs hits, and whole clusters, whose time is off by exactly kEpochFault. The chip sends hits in order of time but
/// for a microsecond or two, so of all ways to shift some rows by one fault the likeliest is taken (Viterbi over rows
/// in order of arrival): the one that needs few shifts, leaves no step back in time and no neighbouring pixels exactly
/// one fault apart. Rows too early by a fault are rarer than rows too late. A whole cluster that is off by a fault in
/// a long silence cannot be told from one that is not.
/// What it decides depends on the rows alone, not on how they are handed over.
class EpochRepair {
 public:
  /// Takes the next rows in order of arrival. Returns the rows that they settle, repaired, in order of arrival; valid
  /// until the next call.
  [[nodiscard]] std::span<const Hit> add(std::span<const Hit> hits);
  /// Chip time has reached t without a row.
  [[nodiscard]] std::span<const Hit> advance(ChipTime t);
  /// Settles all rows: nothing follows them.
  [[nodiscard]] std::span<const Hit> flush();

  [[nodiscard]] std::int64_t repaired() const { return repaired_; }

 private:
  /// A row that is settled or waits, and what shift it got.
  struct Row {
    Hit hit;
    std::uint8_t shift = 0;  ///< index into the table of shifts
    bool odd = false;        ///< its step from the row before is one that a shift may mend
  };
  void settle_old(ChipTime now);
  void settle(std::size_t end);
  void forget_settled();
  [[nodiscard]] std::span<Row> pending() { return std::span(rows_).subspan(first_, end_ - first_); }
  [[nodiscard]] static bool beside_row_before(std::span<const Row> rows, std::size_t i);
  static void find_shifts(std::span<Row> rows, bool first_is_settled);

  std::vector<Row> rows_;  ///< from first_ to before end_ they are pending
  std::size_t first_ = 0;  ///< already settled, once there is one that is: the others follow on it
  std::size_t end_ = 0;
  std::size_t odd_ = 0;  ///< pending rows after the first that are
  bool has_settled_ = false;
  ChipTime newest_ = 0;
  std::vector<Hit> settled_;
  std::int64_t repaired_ = 0;
};

}  // namespace comptonaut
