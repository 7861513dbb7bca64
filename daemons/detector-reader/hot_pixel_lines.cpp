// SPDX-License-Identifier: BSD-3-Clause
#include "hot_pixel_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "bus/daemon.h"

namespace comptonaut {
namespace {

constexpr std::size_t kLines = 10;  ///< of a kind at a time: a chip that goes wrong does not flood the journal

std::string place(const HotPixel& hot) {
  return fmt::format("pixel x {}, y {}", pixel_x(hot.pixel), pixel_y(hot.pixel));
}
std::string found(const HotPixel& hot) {
  return fmt::format("{} is hot, its hits are left out: {} where {:.1f} were expected", place(hot), hot.hits,
                     hot.around);
}
std::string released(const HotPixel& hot) { return place(hot) + " is quiet again, its hits count"; }

void warn(std::span<const HotPixel> pixels, std::string (*line)(const HotPixel&), const char* all) {
  for (const HotPixel& hot : pixels.first(std::min(pixels.size(), kLines))) {
    print_warning("comptonaut-detector-reader", line(hot));
  }
  if (pixels.size() > kLines) {
    print_warning("comptonaut-detector-reader", fmt::format("{} more pixels are {}", pixels.size() - kLines, all));
  }
}

}  // namespace

/// Of those told, some are there no longer; behind the others stand the new ones.
void HotPixelLines::tell(std::span<const HotPixel> masked) {
  std::vector<HotPixel> gone;
  std::size_t known = 0;
  for (const HotPixel& hot : told_) {
    if (known < masked.size() && masked[known] == hot) {
      ++known;
    } else {
      gone.push_back(hot);
    }
  }
  warn(gone, released, "quiet again");
  warn(masked.subspan(known), found, "hot");
  if (!gone.empty() || known < masked.size()) told_.assign(masked.begin(), masked.end());
}

}  // namespace comptonaut
