// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/view_response.h"

#include <algorithm>
#include <array>

#include "core/simd.h"

namespace comptonaut {
namespace {

using Values = std::array<double, kChunk>;

COMPTONAUT_SIMD_CLONES
void place(const View& view, std::size_t n, double* __restrict a, double* __restrict b) {
  for (std::size_t i = 0; i < n; ++i) {
    const SmoothResponse::Place at = SmoothResponse::place_of(view.x_D[i], view.y_D[i], view.z_D[i] + kSomewhere_m);
    a[i] = at.a;
    b[i] = at.b;
  }
}

/// To an axis of D.
COMPTONAUT_SIMD_CLONES
void cosines(const View& view, std::size_t n, double x, double y, double z, double* __restrict cosine) {
  for (std::size_t i = 0; i < n; ++i) {
    const double exact = (view.x_D[i] * x + view.y_D[i] * y + view.z_D[i] * z) / view.d_m[i];
    const double most = exact < 1.0 ? exact : 1.0;
    cosine[i] = most > -1.0 ? most : -1.0;
  }
}

}  // namespace

Eye eye_of(const Viewpoints& viewpoints, std::size_t at, double attenuation_per_m) {
  const Viewpoints& v = viewpoints;
  Eye eye{.p_W = {v.x_m[at], v.y_m[at], v.z_m[at]}, .R_DW = {}, .attenuation_per_m = attenuation_per_m};
  for (int i = 0; i < 9; ++i) eye.R_DW(i / 3, i % 3) = v.R_DW[i][at];
  return eye;
}

void respond(const SmoothResponse& response, const View& view, std::size_t n, double* single, double* pair) {
  Values a, b;
  place(view, n, a.data(), b.data());
  response.at(a.data(), b.data(), n, single, pair);
}

void pair_densities(const JointPhysics& physics, const Pair& pair, const View& view, std::size_t n, double* density) {
  Values of_singles, of_pairs, cosine;
  respond(physics.response, view, n, of_singles.data(), of_pairs.data());
  std::fill_n(density, n, 0.0);
  for (const Hypothesis& hypothesis : pair.hypotheses) {
    const Eigen::Vector3d axis_D = pair.R_DW * hypothesis.axis_W;
    cosines(view, n, axis_D.x(), axis_D.y(), axis_D.z(), cosine.data());
    physics.cones.add(pair.readings, hypothesis.beta_rad, cosine.data(), n, hypothesis.weight, density);
  }
  multiply(of_pairs.data(), view.weight_per_m2.data(), n);
  multiply(density, of_pairs.data(), n);
}

}  // namespace comptonaut
