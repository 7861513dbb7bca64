// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "response/angular_error.h"
#include "response/cone_density.h"

namespace comptonaut {

/// Densities of delta = alpha - beta in one bin.
struct AngleBin {
  double from_rad = 0.0, to_rad = 0.0;
  double pairs = 0.0;             ///< samples in it
  double measured_per_rad = 0.0;  ///< of the readings that a ConeDensity describes: the true ones, and sole ones
  double model_per_rad = 0.0;     ///< mean of the density over the same readings
};

/// From -180 to 180 degrees: bins of one degree within 20, of five beyond. Both densities have integral 1.
[[nodiscard]] std::vector<AngleBin> angle_histogram(std::span<const SimulatedPair> pairs, const ConeDensity& density);

}  // namespace comptonaut
