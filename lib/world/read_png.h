// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>
#include <vector>

namespace comptonaut {

/// A picture's brightness, row by row from its top: 0 black to 1 white; NaN where it is transparent.
struct GreyPicture {
  int columns = 0, rows = 0;
  std::vector<double> grey;
};

[[nodiscard]] bool is_png(std::string_view bytes);

/// Brightness as it is stored, whatever the file says about gamma; colours count as the mean of red, green and blue.
/// Throws std::runtime_error that says what is wrong: not a PNG, cut short, more than 1e8 pixels.
[[nodiscard]] GreyPicture read_png(std::string_view bytes);

}  // namespace comptonaut
