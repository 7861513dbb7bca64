// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/cone_table.h"

namespace comptonaut {

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

}  // namespace comptonaut
