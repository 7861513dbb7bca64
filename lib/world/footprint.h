// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/cells.h"
#include "world/world.h"

namespace comptonaut {

/// Seen from above, what stands on the ground in an area: the voxel columns with occupied space more than one and a
/// half voxels above it, as rectangles that do not overlap, cut to the area. A column counts as flat_cells' does.
/// The ground is the largest part of the surface without a higher step (less is a slope); beside it, that of the
/// nearest of its columns, so that a walled yard is ground as well. Where the area is longer than kFootprintColumns,
/// each column stands for several, and what is thinner may be left out. Flat ground has none.
/// Throws std::invalid_argument as flat_cells does.
[[nodiscard]] std::vector<Area> footprint(const World& world, const Area& area);

inline constexpr int kFootprintColumns = 512;

}  // namespace comptonaut
