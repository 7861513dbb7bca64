// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/cells.h"
#include "nodes/map_tile.h"

namespace comptonaut {

/// The whole map in tiles that each fit one datagram: all but nuclide, mission and utime, which are left to the caller.
[[nodiscard]] std::vector<MapTile> map_tiles(const Cells& cells, std::span<const double> lambda_Bq,
                                             std::span<const double> sensitivity_s);

/// The same of limits per cell, infinite ones as kNothingKnown_Bq.
[[nodiscard]] std::vector<ClearanceTile> clearance_tiles(const Cells& cells, std::span<const double> limits_Bq);

}  // namespace comptonaut
