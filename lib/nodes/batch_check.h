// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/cells.h"
#include "nodes/terrain_tile.h"
#include "radiation/measurement_batch.h"

namespace comptonaut {

/// Whether a batch can be true: numbers finite, directions unit, live time within its duration, the detector not
/// absurdly far from the area, cones where the detector is. What it says is folded for good, so doubt means no.
[[nodiscard]] bool is_sane(const MeasurementBatch& batch, const Area& area);

/// Whether a tile's number and time can be true.
[[nodiscard]] bool is_sane(const TerrainTile& tile);
/// Whether its voxels are of the map that `world` is of, and not absurdly far from the area.
[[nodiscard]] bool fits_map(const TerrainTile& tile, const World& world, const Area& area);

}  // namespace comptonaut
