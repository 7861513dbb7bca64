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
  column.exposure_s.resize(data.live_s.size());
  constexpr std::size_t kSums = 4;  // side by side, as no sum can wait for the one before
  std::vector<std::array<double, kSums>> sums_s(data.live_s.size());
  Seen seen;
  std::array<double, kChunk> of_pairs;
  for (std::size_t first = 0; first < v.size(); first += kChunk) {
    const std::size_t n = std::min(kChunk, v.size() - first);
    see_from(v, first, n, p_W.x(), p_W.y(), p_W.z(), physics.attenuation_per_m, &seen);
    for (std::size_t i = 0; !let_through.empty() && i < n; ++i) seen.weight_s[i] *= let_through[first + i];
    physics.response.at(seen.a.data(), seen.b.data(), n, &column.singles[first], of_pairs.data());
    multiply(&column.singles[first], seen.weight_s.data(), n);
    multiply(of_pairs.data(), seen.weight_s.data(), n);
    for (std::size_t i = 0; i < n; ++i) sums_s[v.drone[first + i]][i % kSums] += of_pairs[i];
  }
  for (std::size_t d = 0; d < sums_s.size(); ++d) {
    column.exposure_s[d] = (sums_s[d][0] + sums_s[d][1]) + (sums_s[d][2] + sums_s[d][3]);
  }
}

/// Some pairs as arrays. A reading that a pair has not weighs nothing.
struct PairArrays {
  static constexpr std::size_t kMost = 64;
  using Values = std::array<double, kMost>;

  void take(std::span<const Pair> pairs);

  std::size_t n = 0;
  std::array<Values, 3> p_WS;
  std::array<Values, 9> R_DW;  ///< row by row
  struct Reading {
    std::array<Values, 3> axis_W;
    Values weight;
    ConeTable::Cones cones;
  };
  std::array<Reading, 2> readings;
};

void PairArrays::take(std::span<const Pair> pairs) {
  n = pairs.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Pair& pair = pairs[i];
    for (int axis = 0; axis < 3; ++axis) p_WS[axis][i] = pair.p_WS[axis];
    for (int r = 0; r < 9; ++r) R_DW[r][i] = pair.R_DW(r / 3, r % 3);
    for (std::size_t h = 0; h < readings.size(); ++h) {
      const Hypothesis& hypothesis = pair.hypotheses[std::min(h, pair.hypotheses.size() - 1)];
      Reading& reading = readings[h];
      for (int axis = 0; axis < 3; ++axis) reading.axis_W[axis][i] = hypothesis.axis_W[axis];
      reading.weight[i] = h < pair.hypotheses.size() ? hypothesis.weight : 0.0;
      reading.cones.set(i, pair.readings, hypothesis.beta_rad);
    }
  }
}

/// One place seen from some pairs: as Seen, and its angles to the axes.
struct SeenByPairs {
  PairArrays::Values a, b, weight_per_m2;
  std::array<PairArrays::Values, 2> cos_alpha;
};

COMPTONAUT_SIMD_CLONES
void see_from_pairs(const PairArrays& pairs, double px, double py, double pz, double mu, SeenByPairs* __restrict seen) {
  const auto& R = pairs.R_DW;
  for (std::size_t i = 0; i < pairs.n; ++i) {
    const double dx = px - pairs.p_WS[0][i], dy = py - pairs.p_WS[1][i], dz = pz - pairs.p_WS[2][i];
    const double square = dx * dx + dy * dy + dz * dz;
    const double clipped = square > kSquareMin_m2 ? square : kSquareMin_m2;
    const double d_m = std::sqrt(clipped), per_d = 1.0 / d_m;
    seen->weight_per_m2[i] = exp_minus_inline(mu * d_m) * (per_d * per_d);
    const SmoothResponse::Place place =
        SmoothResponse::place_of(R[0][i] * dx + R[1][i] * dy + R[2][i] * dz, R[3][i] * dx + R[4][i] * dy + R[5][i] * dz,
                                 R[6][i] * dx + R[7][i] * dy + R[8][i] * dz + kSomewhere_m);
    seen->a[i] = place.a;
    seen->b[i] = place.b;
    for (std::size_t h = 0; h < 2; ++h) {
      const auto& axis_W = pairs.readings[h].axis_W;
      const double along = (dx * axis_W[0][i] + dy * axis_W[1][i] + dz * axis_W[2][i]) * per_d;
      const double most = along < 1.0 ? along : 1.0;
      seen->cos_alpha[h][i] = most > -1.0 ? most : -1.0;
    }
  }
}

void fill_pairs(const JointPhysics& physics, std::span<const Pair> pairs, const Eigen::Vector3d& p_W,
                std::vector<double>& densities) {
  densities.assign(pairs.size(), 0.0);
  PairArrays arrays;
  SeenByPairs seen;
  PairArrays::Values of_singles, of_pairs;
  for (std::size_t first = 0; first < pairs.size(); first += PairArrays::kMost) {
    arrays.take(pairs.subspan(first, std::min(PairArrays::kMost, pairs.size() - first)));
    see_from_pairs(arrays, p_W.x(), p_W.y(), p_W.z(), physics.attenuation_per_m, &seen);
    physics.response.at(seen.a.data(), seen.b.data(), arrays.n, of_singles.data(), of_pairs.data());
    double* density = &densities[first];
    for (std::size_t h = 0; h < 2; ++h) {
      const PairArrays::Reading& reading = arrays.readings[h];
      physics.cones.add(reading.cones, seen.cos_alpha[h].data(), reading.weight.data(), arrays.n, density);
    }
    multiply(of_pairs.data(), seen.weight_per_m2.data(), arrays.n);
    multiply(density, of_pairs.data(), arrays.n);
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
  fill_pairs(physics, data.pairs, p_W, column.pairs);
  column.slope_per_m = {};
  for (std::size_t i = 0; data.sight && i < column.pairs.size(); ++i) column.pairs[i] *= let_through.pairs[i];
}

}  // namespace comptonaut
