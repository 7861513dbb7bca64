// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>

#include "detector/hit.h"
#include "scratch.h"

namespace comptonaut {

/// Into the scratch folder: a chip whose every pixel reads one tick per keV.
inline void write_calibration() {
  const std::pair<const char*, const char*> matrices[] = {
      {"a.txt", "1 "}, {"b.txt", "0 "}, {"c.txt", "0 "}, {"t.txt", "0 "}};
  for (const auto& [name, value] : matrices) {
    std::string matrix;
    for (int y = 0; y < kChipPixels; ++y) {
      for (int x = 0; x < kChipPixels; ++x) matrix += value;
      matrix += "\n";
    }
    scratch_file(name, matrix);
  }
}

}  // namespace comptonaut
