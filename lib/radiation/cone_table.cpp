// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/cone_table.h"

#include <array>
#include <cstdint>

#include "core/simd.h"

namespace comptonaut {
namespace {

using Cones = ConeTable::Cones;

/// Between which two values, and how far on the way.
struct Lookup {
  std::array<std::int32_t, Cones::kMost> value;
  std::array<double, Cones::kMost> part;
};

COMPTONAUT_SIMD_CLONES
void look_up(const Cones& cones, const double* __restrict cos_alpha, std::size_t n, Lookup* __restrict to) {
  constexpr std::int32_t kRows = ConeTable::kRows, kSteps = ConeTable::kSteps;
  for (std::size_t i = 0; i < n; ++i) {
    const std::int32_t row = cones.row[i] > kRows ? cones.row[i] - (kRows + 1) : cones.row[i];
    const double at = (quick_acos(cos_alpha[i]) - cones.beta_rad[i]) * ConeTable::kStepsPerRad + row * (kSteps / kRows);
    const double positive = at > 0.0 ? at : 0.0, clipped = positive < kSteps ? positive : kSteps;
    const auto whole = static_cast<std::int32_t>(clipped);
    const std::int32_t step = whole < kSteps - 1 ? whole : kSteps - 1;
    to->value[i] = cones.row[i] * (kSteps + 1) + step;
    to->part[i] = clipped - step;
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

void ConeTable::add(const Cones& cones, const double* cos_alpha, const double* weight, std::size_t n,
                    double* density) const {
  Lookup places;
  look_up(cones, cos_alpha, n, &places);
  for (std::size_t i = 0; i < n; ++i) {
    const float* value = &values_[static_cast<std::size_t>(places.value[i])];
    const double low = value[0], high = value[1];
    density[i] += weight[i] * (low + places.part[i] * (high - low));
  }
}

void ConeTable::add(Readings readings, double beta_rad, const double* cos_alpha, std::size_t n, double weight,
                    double* density) const {
  Cones cones;
  std::array<double, Cones::kMost> weights;
  weights.fill(weight);
  for (std::size_t i = 0; i < Cones::kMost; ++i) cones.set(i, readings, beta_rad);
  for (std::size_t first = 0; first < n; first += Cones::kMost) {
    add(cones, cos_alpha + first, weights.data(), std::min(Cones::kMost, n - first), density + first);
  }
}

}  // namespace comptonaut
