// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace comptonaut {

class Config;

/// The published estimator.
struct MlemConfig {
  double attenuation_per_m = 0.0093;  ///< mu, of air at 662 keV
  double cone_sigma_rad = 0.10;       ///< sigma of h, the spread of the angle to the cone's surface
  double core_cut = 1e-3;             ///< h below it counts as zero
  double row_cut = 0.0;               ///< and so does an entry below it times the largest of its row
  int iterations = 10;
  double source_radius_m = 2.0;  ///< activity of a maximum: the cells within this distance that lie nearest to it
};

[[nodiscard]] MlemConfig read_mlem_config(Config& config);

}  // namespace comptonaut
