// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "detector/hot_pixels.h"

namespace comptonaut {

/// Says in the journal, once each time, which pixel is masked as hot, and which is no longer.
class HotPixelLines {
 public:
  void tell(std::span<const HotPixel> masked);

 private:
  std::vector<HotPixel> told_;
};

}  // namespace comptonaut
