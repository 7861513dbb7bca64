// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "detector/row_faults.h"

namespace comptonaut {

/// What a stream held.
struct HitStreamCounts {
  std::int64_t rows = 0;
  std::int64_t hits = 0;
  std::int64_t repaired = 0;   ///< hits that were off by kEpochFault
  std::int64_t saturated = 0;  ///< hits whose ToT is at the counter's end
  std::int64_t lost_gaps = 0;  ///< times that the chip lost data
  std::int64_t epochs = 0;
  RowFaults faults;

  HitStreamCounts& operator+=(const HitStreamCounts& other);
};

}  // namespace comptonaut
