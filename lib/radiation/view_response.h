// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "radiation/response_column.h"
#include "radiation/view.h"

namespace comptonaut {

/// Of one viewpoint.
[[nodiscard]] Eye eye_of(const Viewpoints& viewpoints, std::size_t at, double attenuation_per_m);

/// L of singles and of pairs for each of the first n directions of a view.
void respond(const SmoothResponse& response, const View& view, std::size_t n, double* single, double* pair);

/// t_i of one pair for sources at the first n places of a view from its scatter point, obstacles left out:
/// pair_density, but for rounding.
void pair_densities(const JointPhysics& physics, const Pair& pair, const View& view, std::size_t n, double* density);

}  // namespace comptonaut
