// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "detector/row_faults.h"
#include "detector/stream_item.h"

namespace comptonaut {

/// Reads .t3p data as they come, cut anywhere: records of 16 bytes, little-endian: matrix index (u32), ToA (u64, ticks
/// of 25 ns), Overflow (u8), FToA (u8), ToT (u16). They mean what the columns of .t3pa mean; a running Index there is
/// none, so that a measurement that was appended shows by its ToA alone. What stands in the place of a line is the
/// number of the record, from 1. Records that are not right are counted in faults(), never guessed.
class T3pParser {
 public:
  static constexpr std::size_t kRecord = 16;

  /// What the complete records up to now say that has not been returned yet; valid until the next call.
  [[nodiscard]] std::span<const StreamItem> parse(std::span<const char> bytes);
  /// The data have ended; a record that is not complete is a fault.
  [[nodiscard]] std::span<const StreamItem> end();

  [[nodiscard]] std::int64_t rows() const { return rows_; }
  [[nodiscard]] const RowFaults& faults() const { return faults_; }

 private:
  [[nodiscard]] StreamItem* parse_records(std::span<const char> bytes, StreamItem* out);

  std::array<char, kRecord> tail_{};  ///< beginning of a record whose end has not come
  std::size_t tail_size_ = 0;
  std::int64_t rows_ = 0;
  std::vector<StreamItem> items_;  ///< room for what one call returns
  RowFaults faults_;
};

}  // namespace comptonaut
