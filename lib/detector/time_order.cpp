// SPDX-License-Identifier: BSD-3-Clause
#include "detector/time_order.h"

#include <algorithm>

namespace comptonaut {
namespace {

/// Farther out of place than this, a hit waits for a sort of all.
constexpr std::ptrdiff_t kMaxSteps = 32;

bool earlier(const Hit& a, const Hit& b) { return a.t < b.t; }

}  // namespace

bool TimeOrder::add(const Hit& hit) {
  if (hit.t < until_) return false;
  drop_released();
  hits_.push_back(hit);
  if (!sorted_ || hits_.size() == 1) return true;
  auto place = hits_.end() - 1;
  const auto limit = hits_.end() - std::min<std::ptrdiff_t>(kMaxSteps, std::ssize(hits_));
  while (place != limit && (place - 1)->t > hit.t) --place;
  sorted_ = place == hits_.begin() || (place - 1)->t <= hit.t;
  if (sorted_) std::rotate(place, hits_.end() - 1, hits_.end());
  return true;
}

std::span<const Hit> TimeOrder::release(ChipTime horizon) {
  drop_released();
  if (!sorted_) std::stable_sort(hits_.begin(), hits_.end(), earlier);
  sorted_ = true;
  const auto end = std::partition_point(hits_.begin(), hits_.end(), [&](const Hit& hit) { return hit.t < horizon; });
  auto quiet = end;
  ChipTime next = horizon;
  while (quiet != hits_.begin() && next - (quiet - 1)->t <= quiet_) next = (--quiet)->t;
  if (quiet == hits_.begin() && end - hits_.begin() > static_cast<std::ptrdiff_t>(kMaxStretch)) quiet = end;
  released_ = static_cast<std::size_t>(quiet - hits_.begin());
  until_ = std::max(until_, released_ < hits_.size() ? std::min(horizon, quiet->t) : horizon);
  return {hits_.data(), released_};
}

void TimeOrder::drop_released() {
  hits_.erase(hits_.begin(), hits_.begin() + static_cast<std::ptrdiff_t>(released_));
  released_ = 0;
}

}  // namespace comptonaut
