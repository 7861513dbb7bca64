// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace comptonaut {

/// sRGB, 0..1 each.
struct Colour {
  double red = 0.0;
  double green = 0.0;
  double blue = 0.0;
};

/// Of things to tell apart: after Okabe and Ito, with any colour vision, as in the report's page.
[[nodiscard]] Colour category_colour(std::size_t index);

/// Of a scale, 0 at its bottom, 1 at its top: even steps of lightness in OKLab (Ottosson 2020) from near white through
/// orange and red to a dark violet, as in the report's page.
[[nodiscard]] Colour scale_colour(double share);

}  // namespace comptonaut
