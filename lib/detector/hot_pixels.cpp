// SPDX-License-Identifier: BSD-3-Clause
#include "detector/hot_pixels.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "core/statistics.h"
#include "core/time.h"

namespace comptonaut {
namespace {

constexpr std::size_t kPixels = std::size_t{kChipPixels} * kChipPixels;
constexpr int kReach_px = 2;
constexpr unsigned kLooks = 8;        ///< a pixel is looked at every so many of its hits
constexpr double kReleased = 0.5;     ///< of what makes it hot
constexpr ChipTime kHalvesKnown = 3;  ///< after so many without a hit nothing is left in the window

void require(bool right, const char* name, double value, const char* what) {
  if (!right) throw std::invalid_argument(fmt::format("hot_pixels: {} = {}: must be {}", name, value, what));
}

}  // namespace

void check(const HotPixelConfig& config) {
  require(config.window_s >= 0.01 && config.window_s <= 3600.0, "window_s", config.window_s, "from 0.01 to 3600");
  require(config.times_around >= 2.0 && config.times_around <= 1e6, "times_around", config.times_around,
          "from 2 to 1000000");
  require(config.hits_min >= 16 && config.hits_min <= 60'000, "hits_min", config.hits_min, "from 16 to 60000");
}

HotPixels::HotPixels(const HotPixelConfig& config) : config_(config), now_(kPixels), before_(kPixels) {
  check(config);
  half_ = static_cast<ChipTime>(0.5e9 * config.window_s / kChipTime_ns);
}

HotPixels::Split HotPixels::split(std::span<const Hit> hits, ChipTime until) {
  left_out_.clear();
  std::size_t count = count_kept(hits);
  if (count < hits.size()) {
    kept_.clear();
    for (auto rest = hits; !rest.empty(); count = count_kept(rest)) {
      const auto kept = rest.first(count);
      kept_.insert(kept_.end(), kept.begin(), kept.end());
      rest = rest.subspan(count);
      if (rest.empty()) break;
      left_out_.push_back(rest.front());
      rest = rest.subspan(1);
    }
  }
  if (until >= from_ + half_) pass_to(until);
  hits_ += std::ssize(left_out_);
  return {.kept = left_out_.empty() ? hits : std::span<const Hit>(kept_), .left_out = left_out_};
}

/// Counts hits up to the first that is left out, and that one; returns how many are before it.
std::size_t HotPixels::count_kept(std::span<const Hit> hits) {
  std::size_t kept = 0;
  while (kept < hits.size()) {
    if (!in_half(hits[kept].t)) pass_to(hits[kept].t);
    const auto rest = hits.subspan(kept);
    const auto end = std::ranges::partition_point(rest, [&](const Hit& hit) { return in_half(hit.t); });
    const std::span<const Hit> half(rest.begin(), end);
    const std::size_t count = count_kept_of_half(half);
    kept += count;
    if (count < half.size()) break;
  }
  return kept;
}

/// The same of hits of the half that goes on.
std::size_t HotPixels::count_kept_of_half(std::span<const Hit> hits) {
  std::uint16_t* const now = now_.data();
  const std::int64_t hits_before = now_hits_;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const std::uint16_t pixel = hits[i].pixel, count = ++now[pixel];
    if (count % kLooks != 0 && masked_.empty()) [[likely]]
      continue;
    now_hits_ = hits_before + static_cast<std::int64_t>(i);
    if (count == 0) now[pixel] = std::numeric_limits<std::uint16_t>::max();
    if (hot_[pixel]) return i;
    ++now_hits_;
    if (count % kLooks == 0) find_hot(pixel);
    if (hot_[pixel]) return i;
  }
  now_hits_ = hits_before + std::ssize(hits);
  return hits.size();
}

void HotPixels::pass_to(ChipTime t) {
  const ChipTime halves = std::clamp<ChipTime>((t - from_) / half_, 1, kHalvesKnown);
  for (ChipTime i = 0; i < halves; ++i) end_half();
  from_ = floor_to(t, half_);
}

bool HotPixels::in_half(ChipTime t) const {
  return static_cast<std::uint64_t>(t - from_) < static_cast<std::uint64_t>(half_);
}

void HotPixels::end_half() {
  std::erase_if(masked_, [&](const HotPixel& hot) {
    const double least = std::max<double>(config_.hits_min, config_.times_around * expected(hot.pixel));
    const bool quiet = hits_of(hot.pixel) < kReleased * least;
    if (quiet) hot_.reset(hot.pixel);
    return quiet;
  });
  now_.swap(before_);
  std::fill(now_.begin(), now_.end(), 0);
  before_hits_ = now_hits_;
  now_hits_ = 0;
}

void HotPixels::find_hot(std::uint16_t pixel) {
  const int hits = hits_of(pixel);
  if (hits < config_.hits_min || hits < config_.times_around * chip_mean()) return;
  const double around = expected(pixel);
  if (hits < config_.times_around * around) return;
  hot_.set(pixel);
  masked_.push_back({.pixel = pixel, .hits = hits, .around = around});
  ++times_;
}

double HotPixels::chip_mean() const { return static_cast<double>(now_hits_ + before_hits_) / kPixels; }

double HotPixels::expected(std::uint16_t pixel) const {
  std::vector<double> others;
  const int x = pixel_x(pixel), y = pixel_y(pixel);
  for (int v = std::max(0, y - kReach_px); v <= std::min(kChipPixels - 1, y + kReach_px); ++v) {
    for (int u = std::max(0, x - kReach_px); u <= std::min(kChipPixels - 1, x + kReach_px); ++u) {
      const auto other = static_cast<std::size_t>(kChipPixels * v + u);
      if (other != pixel && !hot_[other]) others.push_back(hits_of(other));
    }
  }
  return others.empty() ? chip_mean() : std::max(chip_mean(), median(std::move(others)));
}

}  // namespace comptonaut
