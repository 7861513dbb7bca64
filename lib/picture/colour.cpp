// SPDX-License-Identifier: BSD-3-Clause
#include "picture/colour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace comptonaut {
namespace {

double cube(double x) { return x * x * x; }

double to_srgb(double linear) {
  const double c = std::clamp(linear, 0.0, 1.0);
  return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
}

Colour from_oklch(double lightness, double chroma, double hue_rad) {
  const double a = chroma * std::cos(hue_rad), b = chroma * std::sin(hue_rad);
  const double l = cube(lightness + 0.3963377774 * a + 0.2158037573 * b);
  const double m = cube(lightness - 0.1055613458 * a - 0.0638541728 * b);
  const double s = cube(lightness - 0.0894841775 * a - 1.2914855480 * b);
  return {.red = to_srgb(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
          .green = to_srgb(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          .blue = to_srgb(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

}  // namespace

Colour category_colour(std::size_t index) {
  constexpr std::array<int, 7> kOkabeIto = {0x0072b2, 0xd55e00, 0x009e73, 0xb0568a, 0x3d9bd6, 0x8f6b00, 0x4d4d4d};
  const int rgb = kOkabeIto[index % kOkabeIto.size()];
  return {.red = (rgb >> 16) / 255.0, .green = (rgb >> 8 & 0xff) / 255.0, .blue = (rgb & 0xff) / 255.0};
}

Colour scale_colour(double share) {
  const double v = std::clamp(share, 0.0, 1.0);
  return from_oklch(0.985 - 0.765 * v, 0.012 + 0.62 * v * (1 - v) * (0.75 - 0.2 * v) + 0.09 * v * v,
                    (95 - 165 * std::pow(v, 1.15)) * std::numbers::pi / 180.0);
}

}  // namespace comptonaut
