// SPDX-License-Identifier: BSD-3-Clause
#include "detector/live_time.h"

#include <algorithm>

namespace comptonaut {

void LiveTime::lost(ChipTime from, ChipTime to) {
  if (to <= from) return;
  const auto first = std::partition_point(lost_.begin(), lost_.end(), [&](const Interval& i) { return i.to < from; });
  const auto last = std::partition_point(first, lost_.end(), [&](const Interval& i) { return i.from <= to; });
  for (auto i = first; i != last; ++i) {
    from = std::min(from, i->from);
    to = std::max(to, i->to);
  }
  lost_.insert(lost_.erase(first, last), {from, to});
}

ChipTime LiveTime::live(ChipTime from, ChipTime to) const {
  ChipTime sum = 0;
  for (const Interval& alive : alive_) {
    const Interval seen{std::max(alive.from, from), std::min(alive.to, to)};
    if (seen.to <= seen.from) continue;
    sum += seen.to - seen.from;
    for (const Interval& lost : lost_) {
      sum -= std::max<ChipTime>(0, std::min(lost.to, seen.to) - std::max(lost.from, seen.from));
    }
  }
  return sum;
}

void LiveTime::forget_before(ChipTime t) {
  std::erase_if(lost_, [&](const Interval& i) { return i.to <= t; });
  while (alive_.size() > 1 && alive_.front().to <= t) alive_.erase(alive_.begin());
}

}  // namespace comptonaut
