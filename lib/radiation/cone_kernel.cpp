// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/cone_kernel.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <span>

#include "core/simd.h"
#include "radiation/smooth_response.h"
#include "radiation/view.h"

namespace comptonaut {
namespace {

/// (arcsin(sqrt(z)))^2 / z for 0 <= z <= 1/2, within 3e-6: interpolated at Chebyshev's points.
constexpr std::array<double, 6> kAsinSquare = {0.999998307, 0.333575748,  0.172293399,
                                               0.158193286, -0.068856437, 0.267757497};

/// The same for 0 <= z <= 0.05, within 5e-7, and growing beyond.
constexpr std::array<double, 3> kAsinSquareNear = {1.000000471, 0.333164003, 0.186705822};
constexpr double kNear_rad = 0.451;  ///< 2 arcsin(sqrt(0.05))

/// What the reach is widened by, for rounding.
constexpr double kSlack = 2e-6;

constexpr float kExponentMost = 120.0F;

/// 2^-x for 0 <= x <= kExponentMost, within 4e-6 of its value: interpolated at Chebyshev's points of -1/2 to 1/2.
[[gnu::always_inline]] inline float exp2_minus(float x) {
  constexpr float kRounder = 0x1.8p23F;  // adding to it leaves the nearest whole number in the low bits
  const float shifted = kRounder - x;
  const float r = (kRounder - shifted) - x, rr = r * r;
  const float power = (1.0F + 0.693121045F * r) + rr * ((0.24022349F + 0.0559219758F * r) + 0.00966636852F * rr);
  return std::bit_cast<float>(std::bit_cast<std::int32_t>(power) + (std::bit_cast<std::int32_t>(shifted) << 23));
}

/// 1 / sqrt(x) for a normal x > 0, within 8e-7 of its value: a guess from the exponent, improved by two of Newton's
/// steps, centred [Moroz et al. 2018]. Finite for 0. Root and division by the processor take longer.
[[gnu::always_inline]] inline float per_root(float x) {
  const float half = 0.5F * x;
  float y = std::bit_cast<float>(0x5F376908 - (std::bit_cast<std::int32_t>(x) >> 1));
  y = y * (1.50087896F - half * (y * y));
  return y * (1.50000057F - half * (y * y));
}

[[gnu::always_inline]] inline float at(const std::array<float, 6>& c, float z) {
  const float zz = z * z;
  return (c[0] + c[1] * z) + zz * ((c[2] + c[3] * z) + zz * (c[4] + c[5] * z));
}

/// -log2(h) for z = 4 sin^2(delta / 2), the square of the chord. Beyond a right angle arcsin(sqrt(z / 4)) is
/// pi / 2 - arcsin(sqrt(1 - z / 4)).
template <Reach kReach>
[[gnu::always_inline]] inline float exponent_of(const ConeKernel& cone, float z) {
  if (kReach == Reach::kNear) return z * (cone.series[0] + z * (cone.series[1] + z * cone.series[2]));
  if (kReach == Reach::kRight) return z * at(cone.series, z);
  const float other = 4.0F - z, less = z < other ? z : other, positive = less > 0.0F ? less : 0.0F;
  const float near = positive * at(cone.series, positive), far = 2.0F * cone.root_at_right_angle - std::sqrt(near);
  return z < other ? near : far * far;
}

/// Where the cells of a shape lie from its middle, in A and in D.
struct Turned {
  std::array<std::array<float, kBlock>, 6> offset_m;
};

COMPTONAUT_SIMD_CLONES
void turn(const CellBlocks::Shape& __restrict shape, const ConeKernel& __restrict cone, Turned& __restrict turned) {
  for (std::size_t f = 0; f < 6; ++f) {
    const float x = cone.turn[3 * f], y = cone.turn[3 * f + 1], z = cone.turn[3 * f + 2];
    for (std::size_t i = 0; i < kBlock; ++i) {
      turned.offset_m[f][i] = x * shape.offset_m[0][i] + y * shape.offset_m[1][i] + z * shape.offset_m[2][i];
    }
  }
}

/// Of cells, on the way to their entries. In several passes over a group, each so short that a processor works on many
/// cells at once: it looks no farther ahead than some hundred instructions.
struct alignas(64) Polar {
  std::array<float, kGroup * kBlock> z_m, across_square, square, per_m, chord_square;  ///< square: of the distance
};

/// Where the cells of live blocks [from, to), of one shape, are.
COMPTONAUT_SIMD_CLONES
void place(const GroupSeen& seen, std::size_t from, std::size_t to, const Turned& __restrict its, Polar& __restrict at,
           Directions* __restrict direction) {
  constexpr auto kSomewhere = static_cast<float>(kSomewhere_m);
  for (std::size_t k = from; k < to; ++k) {
    const std::size_t b = seen.live[k];
    const float x_m = seen.middle_m[0][b], y_m = seen.middle_m[1][b], z_m = seen.middle_m[2][b];
    const float x_D = seen.middle_m[3][b], y_D = seen.middle_m[4][b], z_D = seen.middle_m[5][b];
    for (std::size_t i = 0; i < kBlock; ++i) {
      const float x = x_m + its.offset_m[0][i], y = y_m + its.offset_m[1][i], z = z_m + its.offset_m[2][i];
      const float across = x * x + y * y;
      at.z_m[k * kBlock + i] = z;
      at.across_square[k * kBlock + i] = across;
      at.square[k * kBlock + i] = across + z * z;
      direction->x_D[k * kBlock + i] = x_D + its.offset_m[3][i];
      direction->y_D[k * kBlock + i] = y_D + its.offset_m[4][i];
      direction->z_D[k * kBlock + i] = z_D + its.offset_m[5][i] + kSomewhere;
    }
  }
}

/// The chord between unit vectors to cell and cone, in the plane of cell and axis, is 2 sin(delta / 2).
COMPTONAUT_SIMD_CLONES
void measure_chords(const ConeKernel& cone, std::size_t n, Polar& __restrict at) {
  const float beta_cos = cone.beta_cos, beta_sin = cone.beta_sin;
  for (std::size_t i = 0; i < n; ++i) {
    const float across = at.across_square[i], per_d = per_root(at.square[i]);
    const float along = at.z_m[i] * per_d - beta_cos, aside = across * per_root(across) * per_d - beta_sin;
    at.per_m[i] = per_d;
    at.chord_square[i] = along * along + aside * aside;
  }
}

template <Reach kReach>
[[gnu::always_inline]] inline void fill(const ConeKernel& cone_, std::size_t n, const Polar& __restrict at,
                                        float* __restrict t) {
  constexpr auto kNearest = static_cast<float>(1.0 / (kDistanceMin_m * kDistanceMin_m));
  const ConeKernel cone = cone_;
  for (std::size_t i = 0; i < n; ++i) {
    const float per_d = at.per_m[i], d_m = at.square[i] * per_d, per_square = per_d * per_d;
    const float exponent = exponent_of<kReach>(cone, at.chord_square[i]);
    const float all = exponent + cone.attenuation_per_m * d_m;
    const float value =
        exp2_minus(all < kExponentMost ? all : kExponentMost) * (per_square < kNearest ? per_square : kNearest);
    t[i] = exponent <= cone.exponent_max ? value : 0.0F;
  }
}

COMPTONAUT_SIMD_CLONES
void fill_near(const ConeKernel& cone, std::size_t n, const Polar& __restrict at, float* __restrict t) {
  fill<Reach::kNear>(cone, n, at, t);
}

COMPTONAUT_SIMD_CLONES
void fill_right(const ConeKernel& cone, std::size_t n, const Polar& __restrict at, float* __restrict t) {
  fill<Reach::kRight>(cone, n, at, t);
}

COMPTONAUT_SIMD_CLONES
void fill_wide(const ConeKernel& cone, std::size_t n, const Polar& __restrict at, float* __restrict t) {
  fill<Reach::kWide>(cone, n, at, t);
}

/// The angle between a block's cells and the cone is at least that of its middle less the block's own opening: a block
/// is live if
///   cos(delta) >= cos(reach + opening),  sin(opening) = radius / d.
COMPTONAUT_SIMD_CLONES
void see_blocks(const double* __restrict x_m, const double* __restrict y_m, const double* __restrict z_m,
                const float* __restrict radius_m, std::size_t n, const ConeKernel& cone_, GroupSeen* __restrict seen,
                std::uint32_t* __restrict live) {
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
    const float clear = across + z_A * z_A - radius * radius, positive = clear > 0.0F ? clear : 0.0F;
    const float cosine_d = z_A * cone.beta_cos + std::sqrt(across) * cone.beta_sin;
    const float least_d = cone.reach_cos * std::sqrt(positive) - cone.reach_sin * radius;
    live[b] = cosine_d >= least_d || !(clear > 0.0F) ? 1 : 0;
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
  const bool wide = reach_rad > 0.5 * std::numbers::pi;
  kernel.reach = wide ? Reach::kWide : reach_rad > kNear_rad ? Reach::kRight : Reach::kNear;
  kernel.reach_cos = wide ? -2.0F : static_cast<float>(std::cos(reach_rad) - kSlack);
  kernel.reach_sin = wide ? 0.0F : static_cast<float>(std::sin(reach_rad) + kSlack);
  // delta = 2 arcsin(sqrt(z / 4)): -log2(h) = scale arcsin^2(sqrt(z / 4))
  const double scale = 2.0 * std::numbers::log2e / (config.cone_sigma_rad * config.cone_sigma_rad);
  std::span<const double> asin_square = kAsinSquare;
  if (kernel.reach == Reach::kNear) asin_square = kAsinSquareNear;
  double power = 0.25 * scale;
  for (std::size_t k = 0; k < asin_square.size(); ++k, power *= 0.25) {
    kernel.series[k] = static_cast<float>(power * asin_square[k]);
  }
  kernel.root_at_right_angle = static_cast<float>(std::sqrt(scale) * 0.25 * std::numbers::pi);
  kernel.exponent_max = static_cast<float>(exponent * std::numbers::log2e);
  kernel.attenuation_per_m = static_cast<float>(config.attenuation_per_m * std::numbers::log2e);
  return kernel;
}

void see_group(const CellBlocks& cells, std::size_t first, std::size_t n, const ConeKernel& cone, GroupSeen& seen) {
  std::array<std::uint32_t, kGroup> live;
  see_blocks(&cells.x_m[first], &cells.y_m[first], &cells.z_m[first], &cells.radius_m[first], n, cone, &seen,
             live.data());
  std::size_t n_live = 0;
  for (std::uint32_t b = 0; b < n; ++b) {
    seen.live[n_live] = b;
    n_live += live[b];
  }
  seen.n_live = n_live;
}

void cone_kernel(const CellBlocks& cells, std::size_t first, const GroupSeen& seen, const ConeKernel& cone, float* t,
                 Directions& directions) {
  const auto shape_of = [&](std::size_t k) { return cells.shape[first + seen.live[k]]; };
  const std::uint32_t last = seen.n_live > 0 ? shape_of(seen.n_live - 1) : 0;
  Turned its;
  Polar at;
  for (std::size_t from = 0, to = 0; from < seen.n_live; from = to) {
    const std::uint32_t shape = shape_of(from);
    to = shape == last ? seen.n_live : from + 1;
    while (to < seen.n_live && shape_of(to) == shape) ++to;
    turn(cells.shapes[shape], cone, its);
    place(seen, from, to, its, at, &directions);
  }
  const std::size_t n = seen.n_live * kBlock;
  measure_chords(cone, n, at);
  (cone.reach == Reach::kWide ? fill_wide : cone.reach == Reach::kRight ? fill_right : fill_near)(cone, n, at, t);
}

COMPTONAUT_SIMD_CLONES
void multiply(float* __restrict t, const float* __restrict factor, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) t[i] *= factor[i];
}

}  // namespace comptonaut
