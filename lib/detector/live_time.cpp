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

void LiveTime::lost_hits(ChipTime t, std::int64_t count) {
  if (lost_hits_.empty() || lost_hits_.back().t != t) lost_hits_.push_back({.t = t});
  lost_hits_.back().count += count;
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

std::int64_t LiveTime::hits_lost(ChipTime from, ChipTime to) const {
  std::int64_t sum = 0;
  for (const Lost& lost : lost_hits_) sum += lost.t >= from && lost.t < to ? lost.count : 0;
  return sum;
}

void LiveTime::forget_before(ChipTime t) {
  std::erase_if(lost_hits_, [&](const Lost& lost) { return lost.t < t; });
  std::erase_if(lost_, [&](const Interval& i) { return i.to <= t; });
  while (alive_.size() > 1 && alive_.front().to <= t) alive_.erase(alive_.begin());
}

}  // namespace comptonaut
