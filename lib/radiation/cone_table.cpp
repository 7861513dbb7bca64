// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/cone_table.h"

#include <array>
#include <cstdint>

#include "core/simd.h"

namespace comptonaut {
namespace {

constexpr std::size_t kFew = 128;  // angles that are looked up at a time

/// Between which values of a row of `last` steps, and how far on the way.
struct Lookup {
  std::array<std::int32_t, kFew> step;
  std::array<double, kFew> part;
};

COMPTONAUT_SIMD_CLONES
void look_up(const double* __restrict cos_alpha, std::size_t n, double beta_rad, double steps_per_rad, double offset,
             std::int32_t last, Lookup* __restrict to) {
  for (std::size_t i = 0; i < n; ++i) {
    const double at = (quick_acos(cos_alpha[i]) - beta_rad) * steps_per_rad + offset;
    const double positive = at > 0.0 ? at : 0.0, clipped = positive < last ? positive : last;
    const auto whole = static_cast<std::int32_t>(clipped);
    to->step[i] = whole < last - 1 ? whole : last - 1;
    to->part[i] = clipped - to->step[i];
  }
}

}  // namespace

ConeTable::ConeTable(const ConeDensity& density, double attitude_sigma_rad) {
  for (const Readings readings : {Readings::kBoth, Readings::kSole}) {
    for (int row = 0; row <= kRows; ++row) {
      const ConeProfile profile = density.profile(std::cos(row / kRowsPerRad), readings, attitude_sigma_rad);
      for (int step = 0; step <= kSteps; ++step) {
        values_.push_back(static_cast<float>(profile.per_sr(std::cos(step / kStepsPerRad))));
      }
    }
  }
}

void ConeTable::add(Readings readings, double beta_rad, const double* cos_alpha, std::size_t n, double weight,
                    double* density) const {
  const int row = static_cast<int>(beta_rad * kRowsPerRad + 0.5);
  const float* values = row_of(readings, row);
  Lookup places;
  for (std::size_t first = 0; first < n; first += kFew) {
    const std::size_t few = std::min(kFew, n - first);
    look_up(cos_alpha + first, few, beta_rad, kStepsPerRad, row * (kSteps / kRows), kSteps, &places);
    for (std::size_t i = 0; i < few; ++i) {
      const float* step = values + places.step[i];
      const double low = step[0], high = step[1];
      density[first + i] += weight * (low + places.part[i] * (high - low));
    }
  }
}

}  // namespace comptonaut
