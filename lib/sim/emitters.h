// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "nodes/truth.h"
#include "sim/scenario.h"

namespace comptonaut {

/// A point that sends out gamma photons of one line, equally into all directions.
struct Emitter {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  ///< m
  double photons_per_s = 0.0;
};

/// Points that a patch is made of: a spiral that fills the disc evenly (Vogel 1979), so close together that a camera
/// at flight height cannot tell it from a disc.
inline constexpr int kPatchPoints = 200;

/// All points of the truth, for a line with this many photons per decay.
[[nodiscard]] std::vector<Emitter> emitters(std::span<const TrueSource> sources, const std::optional<Patch>& patch,
                                            double branching);

}  // namespace comptonaut
