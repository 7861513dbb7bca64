// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "detector/hit.h"

namespace comptonaut {

/// When the detector could see: from its start on as long as it shows life, but for gaps of lost data. A silence
/// longer than it should last is dead time as a whole. Hits that were lost one by one are told apart: what they cost
/// depends on how many there are besides.
class LiveTime {
 public:
  explicit LiveTime(ChipTime silence_max) : silence_max_(silence_max) {}

  /// A sign of life at t. Earlier signs may come later: they change nothing.
  void sign(ChipTime t) {
    Interval& latest = alive_.back();
    if (t <= latest.to) return;
    if (t - latest.to > silence_max_) {
      alive_.push_back({t, t});
    } else {
      latest.to = t;
    }
  }
  /// Signs of life came all the time up to t.
  void lived_until(ChipTime t) { alive_.back().to = std::max(alive_.back().to, t); }
  /// Data of [from, to) were lost.
  void lost(ChipTime from, ChipTime to);
  /// So many hits were lost at t, or are known from then on to have been.
  void lost_hits(ChipTime t, std::int64_t count);
  /// Life of [from, to).
  [[nodiscard]] ChipTime live(ChipTime from, ChipTime to) const;
  /// Hits that were lost one by one in [from, to).
  [[nodiscard]] std::int64_t hits_lost(ChipTime from, ChipTime to) const;
  /// No question about times before t will come.
  void forget_before(ChipTime t);

 private:
  struct Interval {
    ChipTime from = 0;
    ChipTime to = 0;
  };
  struct Lost {
    ChipTime t = 0;
    std::int64_t count = 0;
  };
  ChipTime silence_max_;
  std::vector<Interval> alive_ = {{0, 0}};  ///< ordered, apart from each other
  std::vector<Interval> lost_;              ///< likewise
  std::vector<Lost> lost_hits_;             ///< one for all that came in a row at the same time
};

}  // namespace comptonaut
