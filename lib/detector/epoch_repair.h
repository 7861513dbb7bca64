// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
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
  /// until the next call of any.
  [[nodiscard]] std::span<const Hit> add(std::span<const Hit> hits);
  /// Chip time has reached t without a row.
  [[nodiscard]] std::span<const Hit> advance(ChipTime t);
  /// Settles all rows: nothing follows them.
  [[nodiscard]] std::span<const Hit> flush();

  [[nodiscard]] std::int64_t repaired() const { return repaired_; }

 private:
  [[nodiscard]] std::span<const Hit> settled() const { return std::span(rows_).first(first_); }
  void forget_settled();
  [[nodiscard]] std::size_t pass_calm();
  void take_rows();
  void settle_old(ChipTime now);
  void settle(std::size_t count);
  void shift_rows(std::span<Hit> rows, std::size_t count);
  [[nodiscard]] std::size_t waiting() const { return end_ - first_; }

  /// Rows: before first_ settled and repaired, to be forgotten at the next call; before end_ they wait; the others have
  /// still to be looked at.
  std::vector<Hit> rows_;
  std::size_t first_ = 0;
  std::size_t end_ = 0;
  std::size_t odd_ = 0;            ///< waiting rows whose step from the row before is one that a shift may mend
  std::optional<Hit> before_;      ///< the latest settled row, as it came: the others follow on it
  std::uint8_t before_shift_ = 0;  ///< index into the table of shifts
  ChipTime latest_ = 0;            ///< of the row before end_, as it came
  ChipTime newest_ = 0;            ///< of the waiting rows and the one before
  std::int64_t repaired_ = 0;
  std::vector<Hit> block_;  ///< that is being repaired, as it came
};

}  // namespace comptonaut
