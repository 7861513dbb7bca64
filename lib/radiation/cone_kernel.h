// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>

#include "radiation/cell_blocks.h"
#include "radiation/measurement_batch.h"
#include "radiation/mlem_config.h"

namespace comptonaut {

/// Blocks are worked on in groups of so many, which stay in the first cache.
inline constexpr std::size_t kGroup = 64;

/// How far from the cone h is not zero: up to 25 degrees, up to a right angle, farther.
enum class Reach { kNear, kRight, kWide };

/// One cone of the world as a row's arithmetic needs it. A is a frame whose z axis is the cone's.
struct ConeKernel {
  Eigen::Vector3d p_WS;        ///< scatter point
  std::array<float, 18> turn;  ///< rotates W to A and to D, row by row
  float beta_cos, beta_sin;
  float reach_cos, reach_sin;   ///< of the angle to the cone beyond which h is zero
  Reach reach;                  ///< where it is wide, no block is out of reach
  std::array<float, 6> series;  ///< -log2(h) over z, in powers of z = 4 sin^2(delta / 2); the first 3 if reach is near
  float root_at_right_angle;    ///< of -log2(h)
  float exponent_max;           ///< where -log2(h) is larger, h is zero
  float attenuation_per_m;      ///< mu, to base 2
};

/// h(delta) = exp(-(delta / sigma)^2 / 2), zero where it is below core_cut.
[[nodiscard]] ConeKernel make_cone_kernel(const Cone& cone, const Eigen::Matrix3d& R_DW, const MlemConfig& config);

/// Where a group of blocks lies from the scatter point, and which of them the cone may reach.
struct GroupSeen {
  std::array<std::array<float, kGroup>, 6> middle_m;  ///< in A, in D
  std::array<std::uint32_t, kGroup> live;             ///< within the group; the first n_live
  std::size_t n_live = 0;
};

/// Looks at blocks [first, first + n), n at most kGroup.
void see_group(const CellBlocks& cells, std::size_t first, std::size_t n, const ConeKernel& cone, GroupSeen& seen);

/// Directions of cells in D, of any length.
struct alignas(64) Directions {
  std::array<float, kGroup * kBlock> x_D, y_D, z_D;
};

/// exp(-mu d) / d^2 h(delta) of the cells of live blocks, in single precision: within 3e-5 of its value, or 1e-6 of
/// h's largest. d is at least kDistanceMin_m. The same bits on every processor.
void cone_kernel(const CellBlocks& cells, std::size_t first, const GroupSeen& seen, const ConeKernel& cone, float* t,
                 Directions& directions);

/// t *= factor
void multiply(float* t, const float* factor, std::size_t n);

}  // namespace comptonaut
