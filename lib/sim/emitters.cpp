// SPDX-License-Identifier: BSD-3-Clause
#include "sim/emitters.h"

#include <cmath>
#include <numbers>

namespace comptonaut {

std::vector<Emitter> emitters(std::span<const TrueSource> sources, const std::optional<Patch>& patch,
                              double branching) {
  std::vector<Emitter> result;
  for (const TrueSource& source : sources) {
    result.push_back({.p_W = source.p_W, .photons_per_s = branching * source.activity_Bq});
  }
  const double golden_angle_rad = std::numbers::pi * (3.0 - std::sqrt(5.0));
  for (int i = 0; patch && i < kPatchPoints; ++i) {
    const double r_m = patch->radius_m * std::sqrt((i + 0.5) / kPatchPoints);
    const double phi_rad = golden_angle_rad * i;
    result.push_back({.p_W = {patch->x_m + r_m * std::cos(phi_rad), patch->y_m + r_m * std::sin(phi_rad), 0.0},
                      .photons_per_s = branching * patch->activity_Bq / kPatchPoints});
  }
  return result;
}

}  // namespace comptonaut
