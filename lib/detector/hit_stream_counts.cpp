// SPDX-License-Identifier: BSD-3-Clause
#include "detector/hit_stream_counts.h"

namespace comptonaut {

HitStreamCounts& HitStreamCounts::operator+=(const HitStreamCounts& other) {
  rows += other.rows;
  hits += other.hits;
  repaired += other.repaired;
  saturated += other.saturated;
  lost_gaps += other.lost_gaps;
  epochs += other.epochs;
  faults += other.faults;
  return *this;
}

}  // namespace comptonaut
