// SPDX-License-Identifier: BSD-3-Clause
#include "hit_map.h"

#include <fmt/format.h>

#include <algorithm>

namespace comptonaut {
namespace {

constexpr double kTimesNeighbours = 10.0;
constexpr double kHitsMore = 20.0;
constexpr int kReach_px = 2;
constexpr std::size_t kMarked = 10;

/// Median of the pixels around: a few hot ones side by side do not hide each other.
double around(const std::vector<std::int64_t>& hits, int x, int y) {
  std::vector<std::int64_t> others;
  for (int v = std::max(0, y - kReach_px); v <= std::min(kChipPixels - 1, y + kReach_px); ++v) {
    for (int u = std::max(0, x - kReach_px); u <= std::min(kChipPixels - 1, x + kReach_px); ++u) {
      if (u != x || v != y) others.push_back(hits[static_cast<std::size_t>(kChipPixels * v + u)]);
    }
  }
  const auto middle = others.begin() + std::ssize(others) / 2;
  std::nth_element(others.begin(), middle, others.end());
  return static_cast<double>(*middle);
}

}  // namespace

void HitMap::add(std::span<const Hit> hits) {
  for (const Hit& hit : hits) ++hits_[hit.pixel];
}

std::vector<HotPixel> HitMap::hot_pixels() const {
  std::vector<HotPixel> hot;
  for (std::size_t pixel = 0; pixel < hits_.size(); ++pixel) {
    const auto hits = static_cast<double>(hits_[pixel]);
    if (hits < kHitsMore) continue;
    const auto index = static_cast<std::uint16_t>(pixel);
    const double neighbours = around(hits_, pixel_x(index), pixel_y(index));
    if (hits < kTimesNeighbours * neighbours || hits < neighbours + kHitsMore) continue;
    hot.push_back({.pixel = index, .hits = hits_[pixel], .neighbours_hits = neighbours});
  }
  std::stable_sort(hot.begin(), hot.end(), [](const HotPixel& a, const HotPixel& b) { return a.hits > b.hits; });
  return hot;
}

HeatMap HitMap::picture(const std::string& title) const {
  const double most = static_cast<double>(*std::max_element(hits_.begin(), hits_.end()));
  HeatMap map{.title = title,
              .x = {.label = "x, px", .min = 0, .max = kChipPixels},
              .y = {.label = "y, px", .min = 0, .max = kChipPixels},
              .columns = kChipPixels,
              .rows = kChipPixels,
              .values = {hits_.begin(), hits_.end()},
              .scale = {.label = "hits per pixel", .min = 0.5, .max = std::max(10.0, most), .logarithmic = true}};
  for (const HotPixel& hot : hot_pixels()) {
    if (map.marks.size() == kMarked) break;
    map.marks.push_back(
        {.x = pixel_x(hot.pixel) + 0.5, .y = pixel_y(hot.pixel) + 0.5, .label = fmt::format("{}", hot.hits)});
  }
  return map;
}

}  // namespace comptonaut
