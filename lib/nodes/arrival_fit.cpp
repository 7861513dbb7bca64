// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/arrival_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "detector/hit_stream.h"

namespace comptonaut {
namespace {

constexpr std::int64_t kWindow_s = 60;
constexpr double kDrift = 100e-6;
constexpr double kClockSet_us = 500e3;
constexpr std::size_t kClockSet_s = 3;
constexpr double kLeastDelay_us = 1000.0;  // of the quickest row: a frame of USB; cannot be seen in arrivals
constexpr double kFirstDelay_us = 50e3;    // what a single row may have taken

}  // namespace

void ArrivalFit::add(ChipTime newest, Utime arrival) {
  const double t_us = static_cast<double>(newest) / static_cast<double>(kChipTimePerUs);
  if (seconds_.empty()) origin_ = arrival - newest / kChipTimePerUs;
  newest_us_ = t_us;
  const double offset_us = static_cast<double>(arrival - origin_) - t_us;
  if (!seconds_.empty() && offset_us < line_.offset(t_us) - kClockSet_us) seconds_.clear();
  if (seconds_.empty()) rows_ = 0;
  ++rows_;
  const auto second = static_cast<std::int64_t>(1e-6 * t_us);
  if (seconds_.empty() || second != seconds_.back().second) {
    seconds_.push_back({second, t_us, offset_us});
    drop_old();
  } else if (offset_us < seconds_.back().offset_us) {
    seconds_.back() = {second, t_us, offset_us};
  } else {
    return;
  }
  refit();
}

void ArrivalFit::drop_old() {
  const std::int64_t newest = seconds_.back().second;
  const auto before = seconds_.size();
  while (seconds_.front().second <= newest - kWindow_s) seconds_.pop_front();
  rows_ -= rows_ * static_cast<std::int64_t>(before - seconds_.size()) / static_cast<std::int64_t>(before);
  const auto latest = seconds_.size() - std::min(seconds_.size(), kClockSet_s);
  const bool set =
      latest > 0 && std::all_of(seconds_.begin() + static_cast<std::ptrdiff_t>(latest), seconds_.end(),
                                [&](const Quickest& q) { return q.offset_us > line_.offset(q.t_us) + kClockSet_us; });
  if (!set) return;
  seconds_.erase(seconds_.begin(), seconds_.begin() + static_cast<std::ptrdiff_t>(latest));
  rows_ = static_cast<std::int64_t>(seconds_.size());
}

void ArrivalFit::refit() {
  std::vector<Quickest> hull;  // lower, from left to right
  double middle_us = 0.0;
  for (const Quickest& q : seconds_) {
    middle_us += q.t_us / static_cast<double>(seconds_.size());
    const auto above = [&](const Quickest& a, const Quickest& b) {
      return (b.offset_us - a.offset_us) * (q.t_us - a.t_us) >= (q.offset_us - a.offset_us) * (b.t_us - a.t_us);
    };
    while (hull.size() > 1 && above(hull[hull.size() - 2], hull.back())) hull.pop_back();
    hull.push_back(q);
  }
  std::size_t right = 1;
  while (right + 1 < hull.size() && hull[right].t_us < middle_us) ++right;
  double slope = 0.0;
  if (hull.size() > 1) {
    const Quickest &a = hull[right - 1], &b = hull[right];
    slope = std::clamp((b.offset_us - a.offset_us) / (b.t_us - a.t_us), -kDrift, kDrift);
  }
  line_ = {.at_us = newest_us_, .offset_us = std::numeric_limits<double>::max(), .slope = slope};
  for (const Quickest& q : seconds_) {
    line_.offset_us = std::min(line_.offset_us, q.offset_us + slope * (newest_us_ - q.t_us));
  }
  excess_us_ = 0.0;
  for (const Quickest& q : seconds_) {
    excess_us_ += (q.offset_us - line_.offset(q.t_us)) / static_cast<double>(seconds_.size());
  }
}

std::optional<ArrivalFit::Fit> ArrivalFit::fit() const {
  if (seconds_.empty()) return std::nullopt;
  const double sigma_us = std::hypot(kLeastDelay_us, excess_us_, kFirstDelay_us / static_cast<double>(rows_));
  return Fit{.start_utime = origin_ + std::llround(line_.offset(newest_us_)),
             .sigma_us = static_cast<std::int32_t>(std::min(1e9, sigma_us))};
}

}  // namespace comptonaut
