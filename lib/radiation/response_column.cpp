// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/response_column.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/simd.h"
#include "radiation/exp_minus.h"
#include "radiation/sight_lines.h"
#include "radiation/view.h"

namespace comptonaut {
namespace {

constexpr double kSquareMin_m2 = kDistanceMin_m * kDistanceMin_m;

/// One place seen from some viewpoints: where its direction lies on the response's map, Delta_v exp(-mu d) / d^2.
struct Seen {
  std::array<double, kChunk> a, b, weight_s;
};

COMPTONAUT_SIMD_CLONES
void see_from(const Viewpoints& v, std::size_t first, std::size_t n, double px, double py, double pz, double mu,
              Seen* __restrict seen) {
  const double* __restrict vx = &v.x_m[first], * __restrict vy = &v.y_m[first], * __restrict vz = &v.z_m[first];
  const double* __restrict xx = &v.R_DW[0][first], * __restrict xy = &v.R_DW[1][first], * __restrict xz = &v.R_DW[2][first], * __restrict yx = &v.R_DW[3][first], * __restrict yy = &v.R_DW[4][first], * __restrict yz = &v.R_DW[5][first], * __restrict zx = &v.R_DW[6][first], * __restrict zy = &v.R_DW[7][first], * __restrict zz = &v.R_DW[8][first], * __restrict live_s = &v.live_s[first];
  for (std::size_t i = 0; i < n; ++i) {
    const double dx = px - vx[i], dy = py - vy[i], dz = pz - vz[i];
    const double square = dx * dx + dy * dy + dz * dz;
    const double clipped = square > kSquareMin_m2 ? square : kSquareMin_m2;
    seen->weight_s[i] = live_s[i] * exp_minus_inline(mu * std::sqrt(clipped)) / clipped;
    const SmoothResponse::Place place =
        SmoothResponse::place_of(xx[i] * dx + xy[i] * dy + xz[i] * dz, yx[i] * dx + yy[i] * dy + yz[i] * dz,
                                 zx[i] * dx + zy[i] * dy + zz[i] * dz + kSomewhere_m);
    seen->a[i] = place.a;
    seen->b[i] = place.b;
  }
}

void fill_viewpoints(const JointPhysics& physics, const JointData& data, const Eigen::Vector3d& p_W,
                     std::span<const float> let_through, ResponseColumn& column) {
  const Viewpoints& v = data.viewpoints;
  column.singles.resize(v.size());
  column.exposure_s.assign(data.live_s.size(), 0.0);
  Seen seen;
  for (std::size_t first = 0; first < v.size(); first += kChunk) {
    const std::size_t n = std::min(kChunk, v.size() - first);
    see_from(v, first, n, p_W.x(), p_W.y(), p_W.z(), physics.attenuation_per_m, &seen);
    for (std::size_t i = 0; !let_through.empty() && i < n; ++i) seen.weight_s[i] *= let_through[first + i];
    for (std::size_t i = 0; i < n; ++i) {
      const Response L = physics.response.at(seen.a[i], seen.b[i]);
      column.singles[first + i] = seen.weight_s[i] * L.single;
      column.exposure_s[v.drone[first + i]] += seen.weight_s[i] * L.pair;
    }
  }
}

}  // namespace

double pair_density(const JointPhysics& physics, const Pair& pair, const Eigen::Vector3d& p_W) {
  const Eigen::Vector3d to_source_W = p_W - pair.p_WS;
  const double square = std::max(to_source_W.squaredNorm(), kSquareMin_m2);
  const double d_m = std::sqrt(square);
  const Eigen::Vector3d u_W = to_source_W / d_m;
  double density = 0.0;
  for (const Hypothesis& hypothesis : pair.hypotheses) {
    const double cosine = std::clamp(u_W.dot(hypothesis.axis_W), -1.0, 1.0);
    density += hypothesis.weight * physics.cones.per_sr(pair.readings, hypothesis.beta_rad, cosine);
  }
  const Eigen::Vector3d u_D = pair.R_DW * to_source_W;
  const double L = physics.response(u_D.x(), u_D.y(), u_D.z() + kSomewhere_m).pair;
  return L * exp_minus_inline(physics.attenuation_per_m * d_m) / square * density;
}

void fill_column(const JointPhysics& physics, const JointData& data, const Eigen::Vector3d& p_W,
                 ResponseColumn& column) {
  SightLines::Shares let_through;
  if (data.sight) let_through = data.sight->shares(data, physics.obstacles_per_m, p_W);
  fill_viewpoints(physics, data, p_W, let_through.viewpoints, column);
  column.pairs.resize(data.pairs.size());
  for (std::size_t i = 0; i < data.pairs.size(); ++i) {
    column.pairs[i] = pair_density(physics, data.pairs[i], p_W);
    if (data.sight) column.pairs[i] *= let_through.pairs[i];
  }
}

}  // namespace comptonaut
