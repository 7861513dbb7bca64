// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "detector/line_cutter.h"
#include "detector/row_faults.h"
#include "detector/stream_item.h"

namespace comptonaut {

/// Reads a cluster log (.clog) as it comes, cut anywhere: lines `Frame N (start, length s)`, each followed by lines of
/// one cluster, `[x, y, E, ToA] [x, y, E, ToA] ...`, x and y the pixel, E in keV, ToA in ns after the frame's start.
///
/// Its pixels become hits whose energy is given, so that no calibration is applied to them, and go the same way as all
/// hits: the epoch fault is repaired and clusters are found anew, with the rules that made the response table.
///
/// A frame of length 0 comes from a measurement without frames: its start is chip time in ns. A frame with a length is
/// one of a shutter: its start is in s, its chip time counts from the first frame's start, which is UTC if it can be
/// (from the year 2001 on), and between frames the detector was blind.
/// A line that is not right is counted in faults() as a whole: a cluster without one of its pixels has another energy.
class ClogParser {
 public:
  [[nodiscard]] std::span<const StreamItem> parse(std::span<const char> bytes);
  [[nodiscard]] std::span<const StreamItem> end();

  /// Lines of clusters, and lines left out.
  [[nodiscard]] std::int64_t rows() const { return rows_; }
  [[nodiscard]] const RowFaults& faults() const { return faults_; }

  static constexpr std::size_t kMaxLine = std::size_t{1} << 20;

 private:
  struct Frame {
    ChipTime from = 0;
    ChipTime to = 0;  ///< `from` in a measurement without frames
  };
  void parse_line(const char* first, const char* last);
  [[nodiscard]] std::optional<RowFault> parse_frame(const char* first, const char* last);
  [[nodiscard]] std::optional<RowFault> parse_cluster(const char* first, const char* last);
  void close_frame();

  LineCutter lines_{kMaxLine};
  std::int64_t line_ = 0;
  std::int64_t rows_ = 0;
  std::optional<Frame> frame_;           ///< the latest, nullopt after a line that cannot be read
  std::optional<ChipTime> shutter_end_;  ///< of the latest frame with a length
  std::optional<double> origin_s_;       ///< start of the first frame with a length
  std::vector<StreamItem> items_;
  RowFaults faults_;
};

}  // namespace comptonaut
