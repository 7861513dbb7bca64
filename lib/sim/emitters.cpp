// SPDX-License-Identifier: BSD-3-Clause
#include "sim/emitters.h"

#include <cmath>
#include <numbers>

namespace comptonaut {

std::vector<Emitter> emitters(std::span<const TrueSource> sources, const std::optional<Patch>& patch,
                              const std::string& patch_nuclide, const Lines& lines) {
  std::vector<Emitter> result;
  const auto add = [&](const Eigen::Vector3d& p_W, double activity_Bq, const std::string& nuclide) {
    for (const GammaLine& line : lines.at(nuclide)) {
      result.push_back({.p_W = p_W, .photons_per_s = line.per_decay * activity_Bq, .energy_keV = line.energy_keV});
    }
  };
  for (const TrueSource& source : sources) add(source.p_W, source.activity_Bq, source.nuclide);
  const double golden_angle_rad = std::numbers::pi * (3.0 - std::sqrt(5.0));
  for (int i = 0; patch && i < kPatchPoints; ++i) {
    const double r_m = patch->radius_m * std::sqrt((i + 0.5) / kPatchPoints);
    const double phi_rad = golden_angle_rad * i;
    add({patch->x_m + r_m * std::cos(phi_rad), patch->y_m + r_m * std::sin(phi_rad), patch->z_m},
        patch->activity_Bq / kPatchPoints, patch_nuclide);
  }
  return result;
}

}  // namespace comptonaut
