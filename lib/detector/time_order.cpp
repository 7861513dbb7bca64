// SPDX-License-Identifier: BSD-3-Clause
#include "detector/time_order.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace comptonaut {
namespace {

/// Farther out of place than this, a hit waits for a sort of all.
constexpr std::ptrdiff_t kMaxSteps = 32;

bool earlier(const Hit& a, const Hit& b) { return a.t < b.t; }

/// The last few hits of an ordered row of them, to which others come. Rows of one cluster come in any order, a few
/// places off: without branches, since nothing foretells which way they would go.
class Tail {
 public:
  static constexpr std::size_t kHits = 2;

  explicit Tail(const Hit* hits) : first_(words(hits[0])), second_(words(hits[1])) {}
  /// Takes a hit in and gives the earliest away.
  Hit pass(const Hit& hit) {
    Words goes = words(hit);
    exchange(second_, goes);
    exchange(first_, goes);
    return std::bit_cast<Hit>(goes);
  }
  void put(Hit* hits) const {
    hits[0] = std::bit_cast<Hit>(first_);
    hits[1] = std::bit_cast<Hit>(second_);
  }

 private:
  /// A hit as two words.
  struct Words {
    ChipTime t;
    std::int64_t rest;
  };
  static Words words(const Hit& hit) { return std::bit_cast<Words>(hit); }
  /// The later one stays; of two at the same time, the one that came.
  static void exchange(Words& stays, Words& goes) {
    const std::int64_t all_if_swapped = -static_cast<std::int64_t>(stays.t <= goes.t);
    const std::int64_t t = (stays.t ^ goes.t) & all_if_swapped, rest = (stays.rest ^ goes.rest) & all_if_swapped;
    stays.t ^= t;
    goes.t ^= t;
    stays.rest ^= rest;
    goes.rest ^= rest;
  }
  Words first_, second_;
};

}  // namespace

std::int64_t TimeOrder::add(std::span<const Hit> hits) {
  drop_released();
  const std::size_t before = hits_.size();
  hits_.insert(hits_.end(), hits.begin(), hits.end());
  const Hit* hit = hits_.data() + before;
  const Hit* const last = hit + hits.size();
  Hit* end = hits_.data() + before;
  const ChipTime until = until_;
  for (; hit != last && end - hits_.data() < static_cast<std::ptrdiff_t>(released_ + Tail::kHits); ++hit) {
    if (hit->t < until) continue;
    *end = *hit;
    insert(end++);
  }
  if (hit != last) {
    Tail tail(end - Tail::kHits);
    Hit* place = end - Tail::kHits;
    ChipTime latest = place == hits_.data() + released_ ? until : place[-1].t;  // of those before `place`
    for (; hit != last; ++hit) {
      if (hit->t < until) [[unlikely]]
        continue;
      *place = tail.pass(*hit);
      if (place->t < latest) [[unlikely]] {
        if (sorted_) insert(place);
      } else {
        latest = place->t;
      }
      ++place;
    }
    tail.put(place);
    end = place + Tail::kHits;
  }
  const auto late = last - end;
  hits_.erase(hits_.end() - late, hits_.end());
  return late;
}

/// Brings a hit to its place among those before it.
inline void TimeOrder::insert(Hit* place) {
  Hit* const first = hits_.data() + released_;
  if (place == first || place[-1].t <= place->t) [[likely]]
    return;
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
