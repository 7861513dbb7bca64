// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/cone_row.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace comptonaut {
namespace {

/// Cells of a chunk that are near the cone, with what t needs of them.
struct Core {
  std::size_t n = 0;
  std::array<std::size_t, kChunk> i;
  std::array<double, kChunk> x_D, y_D, z_D, t, response;
};

/// Angles within delta_max of the cone's surface, as cosines, so that most cells need no arc cosine.
struct Band {
  double beta_rad, cos_low, cos_high;

  Band(double cos_beta, double delta_max_rad)
      : beta_rad(std::acos(std::clamp(cos_beta, -1.0, 1.0))),
        cos_low(std::cos(std::min(beta_rad + delta_max_rad, std::numbers::pi))),
        cos_high(std::cos(std::max(beta_rad - delta_max_rad, 0.0))) {}
};

void find_core(const View& view, std::size_t n, const Eigen::Vector3d& axis_D, const Band& band, double sigma_rad,
               Core& core) {
  core.n = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double along_m = view.x_D[i] * axis_D.x() + view.y_D[i] * axis_D.y() + view.z_D[i] * axis_D.z();
    const double cosine = std::clamp(along_m / view.d_m[i], -1.0, 1.0);
    if (cosine < band.cos_low || cosine > band.cos_high) continue;
    const double pull = (std::acos(cosine) - band.beta_rad) / sigma_rad;
    core.i[core.n] = i;
    core.x_D[core.n] = view.x_D[i];
    core.y_D[core.n] = view.y_D[i];
    core.z_D[core.n] = view.z_D[i];
    core.t[core.n] = view.weight_per_m2[i] * exp_minus(0.5 * pull * pull);
    ++core.n;
  }
}

}  // namespace

void fill_cone_row(const CellCentres& cells, const ResponseLookup& response, const MlemConfig& config, const Cone& cone,
                   const Eigen::Quaterniond& q_WD, std::span<float> row) {
  const Eigen::Matrix3d R_DW = q_WD.conjugate().toRotationMatrix();
  const Eye eye{.p_W = cone.p_WS, .R_DW = R_DW, .attenuation_per_m = config.attenuation_per_m};
  const Eigen::Vector3d axis_D = R_DW * cone.axis_W;
  const Band band(cone.cos_beta, config.cone_sigma_rad * std::sqrt(-2.0 * std::log(config.core_cut)));
  std::vector<double> exact(row.size(), 0.0);
  View view;
  Core core;
  for (std::size_t first = 0; first < cells.size; first += kChunk) {
    const std::size_t n = std::min(kChunk, cells.size - first);
    see(cells, first, padded(n), eye, view);
    find_core(view, n, axis_D, band, config.cone_sigma_rad, core);
    response(core.x_D.data(), core.y_D.data(), core.z_D.data(), core.response.data(), core.n);
    for (std::size_t k = 0; k < core.n; ++k) exact[first + core.i[k]] = core.t[k] * core.response[k];
  }
  const double largest = *std::max_element(exact.begin(), exact.end());
  const double scale = largest > 0.0 ? 1.0 / largest : 0.0;
  std::transform(exact.begin(), exact.end(), row.begin(), [scale](double t) { return static_cast<float>(t * scale); });
}

}  // namespace comptonaut
