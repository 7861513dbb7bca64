// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <numbers>
#include <vector>

#include "response/response_table.h"

namespace comptonaut {

/// A full sphere of entries that all differ.
inline std::vector<ResponseEntry> response_grid(int step_deg) {
  std::vector<ResponseEntry> entries;
  const double rad = std::numbers::pi / 180.0;
  for (int theta = 0; theta <= 180; theta += step_deg) {
    for (int phi = 0; phi < (theta % 180 == 0 ? 1 : 360); phi += step_deg) {
      const double number = 1.0 + static_cast<double>(entries.size());
      entries.push_back({phi * rad, theta * rad, 1e-6 * number, 0.01, 1e-8 / number, 0.02});
    }
  }
  return entries;
}

}  // namespace comptonaut
