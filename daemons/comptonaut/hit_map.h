// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "detector/hit.h"
#include "picture/picture.h"

namespace comptonaut {

/// A pixel that fires far more often than those around it.
struct HotPixel {
  std::uint16_t pixel = 0;
  std::int64_t hits = 0;
  double neighbours_hits = 0.0;  ///< of those around it, the median
};

/// Hits of each pixel.
class HitMap {
 public:
  void add(std::span<const Hit> hits);

  /// Those with ten times as many hits as the median of the others within two pixels, and at least twenty more; the
  /// hottest first.
  [[nodiscard]] std::vector<HotPixel> hot_pixels() const;
  /// Colours by the logarithm of the number of hits; hot pixels (the first ten) are marked.
  [[nodiscard]] HeatMap picture(const std::string& title) const;

 private:
  std::vector<std::int64_t> hits_ = std::vector<std::int64_t>(kChipPixels * kChipPixels);
};

}  // namespace comptonaut
