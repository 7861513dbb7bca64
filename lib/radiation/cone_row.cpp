// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/cone_row.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "radiation/cone_kernel.h"

namespace comptonaut {
namespace {

/// t *= L, where t is not zero anywhere.
void respond(const CellCentres& cells, std::size_t first, std::size_t n, const Eye& eye, const ResponseLookup& response,
             float* t) {
  std::array<double, kChunk> x_D, y_D, z_D, value;
  see_directions(cells, first, n, eye, x_D.data(), y_D.data(), z_D.data());
  response(x_D.data(), y_D.data(), z_D.data(), value.data(), n);
  for (std::size_t i = 0; i < n; ++i) t[i] *= static_cast<float>(value[i]);
}

}  // namespace

void fill_cone_row(const CellCentres& cells, const ResponseLookup& response, const MlemConfig& config, const Cone& cone,
                   const Eigen::Quaterniond& q_WD, std::span<float> row, std::span<const float> let_through) {
  const Eye eye{
      .p_W = cone.p_WS, .R_DW = q_WD.conjugate().toRotationMatrix(), .attenuation_per_m = config.attenuation_per_m};
  const ConeKernel kernel{.px_m = cone.p_WS.x(),
                          .py_m = cone.p_WS.y(),
                          .pz_m = cone.p_WS.z(),
                          .ax = static_cast<float>(cone.axis_W.x()),
                          .ay = static_cast<float>(cone.axis_W.y()),
                          .az = static_cast<float>(cone.axis_W.z()),
                          .beta_rad = static_cast<float>(std::acos(std::clamp(cone.cos_beta, -1.0, 1.0))),
                          .per_sigma = static_cast<float>(1.0 / config.cone_sigma_rad),
                          .half_square_max = static_cast<float>(-std::log(config.core_cut)),
                          .attenuation_per_m = static_cast<float>(config.attenuation_per_m)};
  float largest = 0.0F;
  for (std::size_t first = 0; first < cells.size; first += kChunk) {
    const std::size_t n = std::min(kChunk, padded(cells.size) - first);
    float* t = &row[first];
    cone_kernel(&cells.x_m[first], &cells.y_m[first], &cells.z_m[first], n, kernel, t);
    if (largest_of(t, n) > 0.0F) respond(cells, first, n, eye, response, t);
    const std::size_t seen = let_through.empty() ? 0 : std::min(n, cells.size - first);
    for (std::size_t i = 0; i < seen; ++i) t[i] *= let_through[first + i];
    largest = std::max(largest, largest_of(t, n));
  }
  cut_and_scale(row.data(), row.size(), largest * static_cast<float>(config.row_cut),
                largest > 0.0F ? 1.0F / largest : 0.0F);
  std::fill(row.begin() + static_cast<std::ptrdiff_t>(cells.size), row.end(), 0.0F);
}

}  // namespace comptonaut
