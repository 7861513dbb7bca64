// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/sensitivity.h"

#include <algorithm>

namespace comptonaut {

void add_sensitivity(const CellCentres& cells, const ResponseLookup& response, double attenuation_per_m,
                     const Viewpoint& viewpoint, std::span<double> sensitivity_s, std::span<const float> let_through) {
  const Eye eye{.p_W = viewpoint.p_WD,
                .R_DW = viewpoint.q_WD.conjugate().toRotationMatrix(),
                .attenuation_per_m = attenuation_per_m};
  View view;
  std::array<float, kChunk> x_D, y_D, z_D, value;
  for (std::size_t first = 0; first < cells.size; first += kChunk) {
    const std::size_t n = std::min(kChunk, cells.size - first);
    see(cells, first, padded(n), eye, view);
    for (std::size_t i = 0; !let_through.empty() && i < n; ++i) view.weight_per_m2[i] *= let_through[first + i];
    std::copy_n(view.x_D.data(), n, x_D.data());
    std::copy_n(view.y_D.data(), n, y_D.data());
    std::copy_n(view.z_D.data(), n, z_D.data());
    response(x_D.data(), y_D.data(), z_D.data(), value.data(), n);
    accumulate(value.data(), view.weight_per_m2.data(), viewpoint.live_s, &sensitivity_s[first], n);
  }
}

}  // namespace comptonaut
