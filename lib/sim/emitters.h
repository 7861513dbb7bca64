// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "detector/nuclide.h"
#include "nodes/truth.h"
#include "sim/scenario.h"

namespace comptonaut {

/// A point that sends out gamma photons of one line, equally into all directions.
struct Emitter {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  ///< m
  double photons_per_s = 0.0;
  double energy_keV = 661.657;
};

/// What each nuclide sends out, by its name.
using Lines = std::map<std::string, std::vector<GammaLine>>;

/// Points that a patch is made of: a spiral that fills the disc evenly (Vogel 1979), so close together that a camera
/// at flight height cannot tell it from a disc.
inline constexpr int kPatchPoints = 200;

/// All points and lines of the truth; a patch is of `patch_nuclide`. Throws std::out_of_range where a nuclide has no
/// lines.
[[nodiscard]] std::vector<Emitter> emitters(std::span<const TrueSource> sources, const std::optional<Patch>& patch,
                                            const std::string& patch_nuclide, const Lines& lines);

}  // namespace comptonaut
