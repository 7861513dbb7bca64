// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/map_tiles.h"

#include <algorithm>
#include <cstdlib>

namespace comptonaut {
namespace {

constexpr std::int32_t kReach = 127;  ///< keys are sent as bytes, relative to the tile's first

template <class Tile>
bool fits(const Tile& tile, VoxelKey key) {
  if (tile.cells.size() >= kMaxCellsPerTile) return false;
  const VoxelKey origin = tile.cells.front().key;
  return std::abs(key.x - origin.x) <= kReach && std::abs(key.y - origin.y) <= kReach &&
         std::abs(key.z - origin.z) <= kReach;
}

/// cell(j): what a tile says of cell j.
template <class Tile, class F>
std::vector<Tile> tiles_of(const Cells& cells, const F& cell) {
  std::vector<Tile> tiles;
  for (std::size_t j = 0; j < cells.size(); ++j) {
    if (tiles.empty() || !fits(tiles.back(), cells.key(j))) {
      tiles.emplace_back();
      tiles.back().cell_m = cells.cell_m();
      tiles.back().tile = static_cast<std::int32_t>(tiles.size()) - 1;
    }
    tiles.back().cells.push_back(cell(j));
  }
  for (Tile& tile : tiles) tile.tiles = static_cast<std::int32_t>(tiles.size());
  return tiles;
}

}  // namespace

std::vector<MapTile> map_tiles(const Cells& cells, std::span<const double> lambda_Bq,
                               std::span<const double> sensitivity_s) {
  return tiles_of<MapTile>(cells, [&](std::size_t j) {
    return MapCell{.key = cells.key(j), .lambda_Bq = lambda_Bq[j], .sensitivity_s = sensitivity_s[j]};
  });
}

std::vector<ClearanceTile> clearance_tiles(const Cells& cells, std::span<const double> limits_Bq) {
  return tiles_of<ClearanceTile>(cells, [&](std::size_t j) {
    return ClearanceCell{.key = cells.key(j), .limit_Bq = std::min(limits_Bq[j], kNothingKnown_Bq)};
  });
}

}  // namespace comptonaut
