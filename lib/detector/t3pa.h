// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/time.h"
#include "detector/line_cutter.h"
#include "detector/row_faults.h"
#include "detector/stream_item.h"

namespace comptonaut {

/// Reads .t3pa text as it comes, cut anywhere: a header line, rows of Index, Matrix Index, ToA, ToT, FToA, Overflow
/// between tabs or spaces, and comment lines, of which "# start_utime_us N" tells UTC of chip time 0 and "# alive ToA"
/// that every hit up to there has been sent. Rows that are not right are counted in faults(), never guessed.
class T3paParser {
 public:
  /// What the complete lines up to now say that has not been returned yet; valid until the next call.
  [[nodiscard]] std::span<const StreamItem> parse(std::span<const char> bytes);
  /// The text has ended: a last line without a line end counts if all its numbers are there.
  [[nodiscard]] std::span<const StreamItem> end();

  /// Lines that held a row: hits, gaps and rows left out.
  [[nodiscard]] std::int64_t rows() const { return rows_; }
  [[nodiscard]] std::int64_t lines() const { return line_; }
  [[nodiscard]] const RowFaults& faults() const { return faults_; }

 private:
  void parse_line(const char* first, const char* last);
  void refuse(RowFault fault);
  void parse_row(const char* first, const char* last);
  void parse_comment(const char* first, const char* last);
  void add(StreamItem::Kind kind, std::int64_t value);

  static constexpr std::size_t kMaxLine = 256;
  LineCutter lines_{kMaxLine};
  std::int64_t line_ = 0;
  std::int64_t rows_ = 0;
  std::vector<StreamItem> items_;
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
/// The same of the side file itself.
[[nodiscard]] T3paInfo read_t3pa_info(std::istream& in, const std::string& file);

}  // namespace comptonaut
