// SPDX-License-Identifier: BSD-3-Clause
#include "config/area.h"

namespace comptonaut {
namespace {

constexpr double kFar_m = 1e5;
constexpr double kSmallest_m = 1.0;

}  // namespace

Area read_area(Config& config) {
  Area area;
  config.require("x_min_m", area.x_min_m, Range{-kFar_m, kFar_m});
  config.require("x_max_m", area.x_max_m, Range{area.x_min_m + kSmallest_m, kFar_m});
  config.require("y_min_m", area.y_min_m, Range{-kFar_m, kFar_m});
  config.require("y_max_m", area.y_max_m, Range{area.y_min_m + kSmallest_m, kFar_m});
  return area;
}

}  // namespace comptonaut
