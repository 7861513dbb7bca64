// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/cone_kernel.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "core/simd.h"
#include "radiation/smooth_response.h"
#include "radiation/view.h"

namespace comptonaut {
namespace {

/// (arcsin(sqrt(z)))^2 / z for 0 <= z <= 1/2, within 3e-6: interpolated at Chebyshev's points.
constexpr std::array<double, 6> kAsinSquare = {0.999998307, 0.333575748,  0.172293399,
                                               0.158193286, -0.068856437, 0.267757497};

constexpr float kExponentMost = 120.0F;

/// 2^-x for 0 <= x <= kExponentMost, within 4e-6 of its value: interpolated at Chebyshev's points of -1/2 to 1/2.
[[gnu::always_inline]] inline float exp2_minus(float x) {
  constexpr float kRounder = 0x1.8p23F;  // adding to it leaves the nearest whole number in the low bits
  const float shifted = kRounder - x;
  const float r = (kRounder - shifted) - x, rr = r * r;
  const float power = (1.0F + 0.693121045F * r) + rr * ((0.24022349F + 0.0559219758F * r) + 0.00966636852F * rr);
  return std::bit_cast<float>(std::bit_cast<std::int32_t>(power) + (std::bit_cast<std::int32_t>(shifted) << 23));
}

[[gnu::always_inline]] inline float at(const std::array<float, 6>& c, float z) {
  const float zz = z * z;
  return (c[0] + c[1] * z) + zz * ((c[2] + c[3] * z) + zz * (c[4] + c[5] * z));
}

/// -log2(h) for z = sin^2(delta / 2). Beyond a right angle arcsin(sqrt(z)) is pi / 2 - arcsin(sqrt(1 - z)).
template <bool kWide>
[[gnu::always_inline]] inline float exponent_of(const ConeKernel& cone, float z) {
  if (!kWide) return z * at(cone.series, z);
  const float other = 1.0F - z, less = z < other ? z : other, positive = less > 0.0F ? less : 0.0F;
  const float near = positive * at(cone.series, positive), far = 2.0F * cone.root_at_right_angle - std::sqrt(near);
  return z < other ? near : far * far;
}

/// Where the cells of a shape lie from its middle, in A and in D.
struct Turned {
  std::array<std::array<float, kBlock>, 6> offset_m;
};

COMPTONAUT_SIMD_CLONES
void turn(const CellBlocks::Shape& shape, const ConeKernel& cone, Turned& turned) {
  for (std::size_t f = 0; f < 6; ++f) {
    const float x = cone.turn[3 * f], y = cone.turn[3 * f + 1], z = cone.turn[3 * f + 2];
    for (std::size_t i = 0; i < kBlock; ++i) {
      turned.offset_m[f][i] = x * shape.offset_m[0][i] + y * shape.offset_m[1][i] + z * shape.offset_m[2][i];
    }
  }
}

/// Live blocks [from, to), of one shape.
template <bool kWide>
[[gnu::always_inline]] inline void fill_run(const GroupSeen& seen, std::size_t from, std::size_t to,
                                            const Turned& __restrict its, const ConeKernel& __restrict cone,
                                            float* __restrict t, Directions* __restrict direction) {
  constexpr auto kNearest = static_cast<float>(1.0 / (kDistanceMin_m * kDistanceMin_m));
  constexpr auto kSomewhere = static_cast<float>(kSomewhere_m);
  for (std::size_t k = from; k < to; ++k) {
    const std::size_t b = seen.live[k];
    const float x_m = seen.middle_m[0][b], y_m = seen.middle_m[1][b], z_m = seen.middle_m[2][b];
    const float x_D = seen.middle_m[3][b], y_D = seen.middle_m[4][b], z_D = seen.middle_m[5][b];
    for (std::size_t i = 0; i < kBlock; ++i) {
      const float x = x_m + its.offset_m[0][i], y = y_m + its.offset_m[1][i], z = z_m + its.offset_m[2][i];
      direction->x_D[k * kBlock + i] = x_D + its.offset_m[3][i];
      direction->y_D[k * kBlock + i] = y_D + its.offset_m[4][i];
      direction->z_D[k * kBlock + i] = z_D + its.offset_m[5][i] + kSomewhere;
      const float across = x * x + y * y, square = across + z * z + 1e-20F;
      const float d_m = std::sqrt(square), per_d = 1.0F / d_m;
      // The chord between unit vectors to cell and cone, in the plane of cell and axis, is 2 sin(delta / 2).
      const float along = z * per_d - cone.beta_cos, aside = std::sqrt(across) * per_d - cone.beta_sin;
      const float exponent = exponent_of<kWide>(cone, 0.25F * (along * along + aside * aside));
      const float all = exponent + cone.attenuation_per_m * d_m, per_square = per_d * per_d;
      const float value =
          exp2_minus(all < kExponentMost ? all : kExponentMost) * (per_square < kNearest ? per_square : kNearest);
      t[k * kBlock + i] = exponent <= cone.exponent_max ? value : 0.0F;
    }
  }
}

COMPTONAUT_SIMD_CLONES
void fill_narrow(const GroupSeen& seen, std::size_t from, std::size_t to, const Turned& __restrict its,
                 const ConeKernel& __restrict cone, float* __restrict t, Directions* __restrict direction) {
  fill_run<false>(seen, from, to, its, cone, t, direction);
}

COMPTONAUT_SIMD_CLONES
void fill_wide(const GroupSeen& seen, std::size_t from, std::size_t to, const Turned& __restrict its,
               const ConeKernel& __restrict cone, float* __restrict t, Directions* __restrict direction) {
  fill_run<true>(seen, from, to, its, cone, t, direction);
}

/// The angle between a block's cells and the cone is at least that of its middle less the block's own opening: a block
/// is live if
///   cos(delta) >= cos(reach + opening),  sin(opening) = radius / d.
COMPTONAUT_SIMD_CLONES
void see_blocks(const double* __restrict x_m, const double* __restrict y_m, const double* __restrict z_m,
                const float* __restrict radius_m, std::size_t n, const ConeKernel& cone_, GroupSeen* __restrict seen,
                std::uint32_t* __restrict live) {
  constexpr float kSlack = 1e-6F;
  const ConeKernel cone = cone_;
  const std::array<float, 18> R = cone.turn;
  const double px = cone.p_WS.x(), py = cone.p_WS.y(), pz = cone.p_WS.z();
  for (std::size_t b = 0; b < n; ++b) {
    const auto x = static_cast<float>(x_m[b] - px);
    const auto y = static_cast<float>(y_m[b] - py);
    const auto z = static_cast<float>(z_m[b] - pz);
    const float x_A = R[0] * x + R[1] * y + R[2] * z;
    const float y_A = R[3] * x + R[4] * y + R[5] * z;
    const float z_A = R[6] * x + R[7] * y + R[8] * z;
    seen->middle_m[0][b] = x_A;
    seen->middle_m[1][b] = y_A;
    seen->middle_m[2][b] = z_A;
    seen->middle_m[3][b] = R[9] * x + R[10] * y + R[11] * z;
    seen->middle_m[4][b] = R[12] * x + R[13] * y + R[14] * z;
    seen->middle_m[5][b] = R[15] * x + R[16] * y + R[17] * z;
    const float radius = radius_m[b], across = x_A * x_A + y_A * y_A;
    const float square = across + z_A * z_A, clear = square - radius * radius;
    const float cosine_d = z_A * cone.beta_cos + std::sqrt(across) * cone.beta_sin;
    const float least_d = cone.reach_cos * std::sqrt(clear > 0.0F ? clear : 0.0F) - cone.reach_sin * radius;
    live[b] = cosine_d + kSlack * std::sqrt(square) >= least_d || !(clear > 0.0F) ? 1 : 0;
  }
}

}  // namespace

ConeKernel make_cone_kernel(const Cone& cone, const Eigen::Matrix3d& R_DW, const MlemConfig& config) {
  ConeKernel kernel{.p_WS = cone.p_WS};
  const Eigen::Matrix3d R_AW =
      Eigen::Quaterniond::FromTwoVectors(cone.axis_W, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  for (int i = 0; i < 9; ++i) {
    kernel.turn[i] = static_cast<float>(R_AW(i / 3, i % 3));
    kernel.turn[9 + i] = static_cast<float>(R_DW(i / 3, i % 3));
  }
  const double cosine = std::clamp(cone.cos_beta, -1.0, 1.0);
  kernel.beta_cos = static_cast<float>(cosine);
  kernel.beta_sin = static_cast<float>(std::sqrt(1.0 - cosine * cosine));
  const double exponent = -std::log(config.core_cut), reach_rad = std::sqrt(2.0 * exponent) * config.cone_sigma_rad;
  kernel.wide = reach_rad > 0.5 * std::numbers::pi;
  kernel.reach_cos = kernel.wide ? -2.0F : static_cast<float>(std::cos(reach_rad));
  kernel.reach_sin = kernel.wide ? 0.0F : static_cast<float>(std::sin(reach_rad));
  // delta = 2 arcsin(sqrt(z)): -log2(h) = scale arcsin^2(sqrt(z))
  const double scale = 2.0 * std::numbers::log2e / (config.cone_sigma_rad * config.cone_sigma_rad);
  for (std::size_t k = 0; k < kernel.series.size(); ++k) kernel.series[k] = static_cast<float>(scale * kAsinSquare[k]);
  kernel.root_at_right_angle = static_cast<float>(std::sqrt(scale) * 0.25 * std::numbers::pi);
  kernel.exponent_max = static_cast<float>(exponent * std::numbers::log2e);
  kernel.attenuation_per_m = static_cast<float>(config.attenuation_per_m * std::numbers::log2e);
  return kernel;
}

void see_group(const CellBlocks& cells, std::size_t first, std::size_t n, const ConeKernel& cone, GroupSeen& seen) {
  std::array<std::uint32_t, kGroup> live;
  see_blocks(&cells.x_m[first], &cells.y_m[first], &cells.z_m[first], &cells.radius_m[first], n, cone, &seen,
             live.data());
  seen.n_live = 0;
  for (std::uint32_t b = 0; b < n; ++b) {
    seen.live[seen.n_live] = b;
    seen.n_live += live[b];
  }
}

void cone_kernel(const CellBlocks& cells, std::size_t first, const GroupSeen& seen, const ConeKernel& cone, float* t,
                 Directions& directions) {
  const auto shape_of = [&](std::size_t k) { return cells.shape[first + seen.live[k]]; };
  Turned its;
  for (std::size_t from = 0, to = 0; from < seen.n_live; from = to) {
    while (to < seen.n_live && shape_of(to) == shape_of(from)) ++to;
    turn(cells.shapes[shape_of(from)], cone, its);
    (cone.wide ? fill_wide : fill_narrow)(seen, from, to, its, cone, t, &directions);
  }
}

COMPTONAUT_SIMD_CLONES
void multiply(float* __restrict t, const float* __restrict factor, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) t[i] *= factor[i];
}

}  // namespace comptonaut
