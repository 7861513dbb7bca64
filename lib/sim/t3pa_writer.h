// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "core/time.h"
#include "detector/hit.h"

namespace comptonaut {

/// Writes hits as a live `.t3pa` stream: rows in order of arrival, and comment lines that tell the stream's start and
/// up to when every hit has been sent.
class T3paWriter {
 public:
  /// Header, and the UTC of chip time 0.
  void start(Utime start_utime);
  void hit(const Hit& hit);
  /// A pair of rows that are no hits: from toa_ticks on data were lost for gap_ticks.
  void lost_data(std::int64_t toa_ticks, std::int64_t gap_ticks);
  void alive(std::int64_t toa_ticks);
  void raw(const std::string& text) { text_ += text; }

  /// What was written since the last call.
  [[nodiscard]] std::string take();

 private:
  void row(int matrix_index, std::int64_t toa_ticks, int tot, int ftoa, int overflow);

  std::string text_;
  std::int64_t index_ = 0;
};

}  // namespace comptonaut
