// SPDX-License-Identifier: BSD-3-Clause
#include "detector/time_order.h"

#include <algorithm>
#include <utility>

namespace comptonaut {
namespace {

/// Farther out of place than this, a hit waits for a sort of all.
constexpr std::ptrdiff_t kMaxSteps = 32;

bool earlier(const Hit& a, const Hit& b) { return a.t < b.t; }

}  // namespace

std::int64_t TimeOrder::add(std::span<const Hit> hits) {
  drop_released();
  const std::size_t before = hits_.size();
  hits_.insert(hits_.end(), hits.begin(), hits.end());
  Hit* const last = hits_.data() + hits_.size();
  Hit* end = hits_.data() + before;
  for (const Hit* hit = end; hit != last; ++hit) {
    if (hit->t < until_) [[unlikely]]
      continue;
    *end = *hit;
    if (sorted_) [[likely]]
      insert(end);
    ++end;
  }
  hits_.erase(hits_.begin() + (end - hits_.data()), hits_.end());
  return last - end;
}

/// Brings a hit to its place among those before it.
inline void TimeOrder::insert(Hit* place) {
  Hit* const first = hits_.data() + released_;
  if (place == first || place[-1].t <= place->t) return;
  const Hit hit = *place;
  Hit* const limit = place - std::min(kMaxSteps, place - first);
  for (; place != limit && place[-1].t > hit.t; --place) place[0] = place[-1];
  sorted_ = place == first || place[-1].t <= hit.t;
  *place = hit;
}

std::span<const Hit> TimeOrder::release(ChipTime horizon) {
  drop_released();
  const auto begin = hits_.begin() + static_cast<std::ptrdiff_t>(released_);
  if (!sorted_) std::stable_sort(begin, hits_.end(), earlier);
  sorted_ = true;
  const auto end = std::partition_point(begin, hits_.end(), [&](const Hit& hit) { return hit.t < horizon; });
  auto quiet = end;
  ChipTime next = horizon;
  while (quiet != begin && next - (quiet - 1)->t <= quiet_) next = (--quiet)->t;
  if (quiet == begin && end - begin > static_cast<std::ptrdiff_t>(kMaxStretch)) quiet = end;
  until_ = std::max(until_, quiet != hits_.end() ? std::min(horizon, quiet->t) : horizon);
  const auto first = std::exchange(released_, static_cast<std::size_t>(quiet - hits_.begin()));
  return std::span(hits_).subspan(first, released_ - first);
}

/// Moves what is left to the beginning, once it is less than what has been released.
void TimeOrder::drop_released() {
  if (2 * released_ < hits_.size()) return;
  hits_.erase(hits_.begin(), hits_.begin() + static_cast<std::ptrdiff_t>(released_));
  released_ = 0;
}

}  // namespace comptonaut
