// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "detector/hit.h"
#include "picture/picture.h"
#include "recording.h"

namespace comptonaut {

/// Hits of each pixel.
class HitMap {
 public:
  void add(std::span<const Hit> hits);

  /// Colours by the logarithm of the number of hits; the first ten hot pixels are marked.
  [[nodiscard]] HeatMap picture(const std::string& title, std::span<const HotPixelTotals> hot_pixels) const;

 private:
  std::vector<std::int64_t> hits_ = std::vector<std::int64_t>(kChipPixels * kChipPixels);
};

}  // namespace comptonaut
