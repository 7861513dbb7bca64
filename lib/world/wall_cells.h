// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/cells.h"
#include "world/world.h"

namespace comptonaut {

/// The walls beside the ground's cells, in cells of the same edge: free voxels above a cell of `ground` that have
/// occupied ones to their sides, where the ground there is more than one and a half cells higher (less is a slope).
/// Each is keyed by the free voxel, so that both sides of a thin wall have their own, and lies kBeforeWall_m before the
/// wall; in a corner, in the middle between its walls.
[[nodiscard]] std::vector<Cells::Cell> wall_cells(const World& world, const Cells& ground);

inline constexpr double kBeforeWall_m = 0.01;

}  // namespace comptonaut
