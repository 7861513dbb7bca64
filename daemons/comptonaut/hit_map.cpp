// SPDX-License-Identifier: BSD-3-Clause
#include "hit_map.h"

#include <fmt/format.h>

#include <algorithm>

namespace comptonaut {
namespace {

constexpr std::size_t kMarked = 10;

}  // namespace

void HitMap::add(std::span<const Hit> hits) {
  for (const Hit& hit : hits) ++hits_[hit.pixel];
}

HeatMap HitMap::picture(const std::string& title, std::span<const HotPixelTotals> hot_pixels) const {
  const double most = static_cast<double>(*std::max_element(hits_.begin(), hits_.end()));
  HeatMap map{.title = title,
              .x = {.label = "x, px", .min = 0, .max = kChipPixels},
              .y = {.label = "y, px", .min = 0, .max = kChipPixels},
              .columns = kChipPixels,
              .rows = kChipPixels,
              .values = {hits_.begin(), hits_.end()},
              .scale = {.label = "hits per pixel", .min = 0.5, .max = std::max(10.0, most), .logarithmic = true}};
  for (const HotPixelTotals& hot : hot_pixels.first(std::min(hot_pixels.size(), kMarked))) {
    map.marks.push_back(
        {.x = pixel_x(hot.pixel) + 0.5, .y = pixel_y(hot.pixel) + 0.5, .label = fmt::format("{}", hot.hits)});
  }
  return map;
}

}  // namespace comptonaut
