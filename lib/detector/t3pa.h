// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/time.h"
#include "detector/hit.h"
#include "detector/row_faults.h"

namespace comptonaut {

/// What one line of a .t3pa text says.
struct T3paItem {
  enum class Kind : std::uint8_t {
    kHit,
    kHeader,     ///< "Index ...": a measurement begins
    kStart,      ///< "# start_utime_us N": UTC of chip time 0, in `value`
    kAlive,      ///< "# alive ToA": every hit up to `value` (chip time) has been sent, and the detector lived
    kLostBegin,  ///< data were lost from `value` (chip time) on
    kLostEnd,    ///< and for `value` units of chip time
  };
  std::int64_t value = 0;   ///< chip time of a hit
  std::uint32_t line = 0;   ///< from 1
  std::uint32_t index = 0;  ///< of a hit: the row's Index
  std::uint16_t pixel = 0;
  std::uint16_t tot = 0;
  Kind kind = Kind::kHit;

  [[nodiscard]] Hit hit() const { return {.t = value, .pixel = pixel, .tot = tot}; }
};

/// Reads .t3pa text as it comes, cut anywhere: a header line, rows of Index, Matrix Index, ToA, ToT, FToA, Overflow
/// between tabs or spaces, comment lines. Rows that are not right are counted in faults(), never guessed.
class T3paParser {
 public:
  /// What the complete lines up to now say that has not been returned yet; valid until the next call.
  [[nodiscard]] std::span<const T3paItem> parse(std::span<const char> bytes);
  /// The text has ended: a last line without a line end counts if all its numbers are there.
  [[nodiscard]] std::span<const T3paItem> end();

  /// Lines that held a row: hits, gaps and rows left out.
  [[nodiscard]] std::int64_t rows() const { return rows_; }
  [[nodiscard]] std::int64_t lines() const { return line_; }
  [[nodiscard]] const RowFaults& faults() const { return faults_; }

 private:
  void keep_tail(const char* first, const char* last);
  void parse_line(const char* first, const char* last);
  void parse_row(const char* first, const char* last);
  void parse_comment(const char* first, const char* last);
  void add(T3paItem::Kind kind, std::int64_t value);

  std::string tail_;  ///< beginning of a line whose end has not come
  bool skipping_ = false;
  std::int64_t line_ = 0;
  std::int64_t rows_ = 0;
  std::vector<T3paItem> items_;
  RowFaults faults_;
};

/// What the side file of a recording (RECORDING.t3pa.info) tells.
struct T3paInfo {
  std::optional<Utime> start_utime;  ///< of chip time 0
  std::string chip;
};

/// The side file of a recording; nullopt where there is none. Throws std::runtime_error that names the file and line
/// where a start time cannot be read.
[[nodiscard]] std::optional<T3paInfo> read_t3pa_info(const std::filesystem::path& recording);

}  // namespace comptonaut
