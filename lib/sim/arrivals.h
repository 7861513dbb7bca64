// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/random.h"
#include "detector/hit.h"
#include "sim/scenario.h"
#include "sim/t3pa_writer.h"

namespace comptonaut {

/// The readout: takes the hits of events in order of time and sends them in order of arrival, in which neighbours can
/// change places (as in real files, 99.9 % of rows are within 1.5 us of order), with the scenario's faults.
class Arrivals {
 public:
  Arrivals(const Traps& traps, std::uint64_t seed, int mav);

  [[nodiscard]] std::string start(Utime start_utime);
  /// One event's hits.
  void add(std::span<const Hit> hits);
  /// Everything that the chip saw before `until` (chip time; not going back from call to call), and that it is alive.
  [[nodiscard]] std::string send(ChipTime until);

 private:
  struct Row {
    ChipTime t = 0;        ///< when it truly happened
    ChipTime arrival = 0;  ///< decides the order of rows
    Hit hit;               ///< as it is sent
  };

  void add_row(const Hit& hit, ChipTime t);
  void add_hot_pixels(ChipTime until);
  void write_gaps(ChipTime until);
  void write_broken_rows(ChipTime until);

  Traps traps_;
  Random order_random_;
  Random trap_random_;
  std::vector<std::uint16_t> hot_pixels_;
  std::vector<Row> rows_;
  T3paWriter writer_;
  ChipTime sent_until_ = 0;
  ChipTime gap_until_ = 0;  ///< rows before are lost
};

}  // namespace comptonaut
