// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/map_tiles.h"

#include <cstdlib>

namespace comptonaut {
namespace {

constexpr std::int32_t kReach = 127;  ///< keys are sent as bytes, relative to the tile's first

bool fits(const MapTile& tile, VoxelKey key) {
  if (tile.cells.size() >= kMaxCellsPerTile) return false;
  const VoxelKey origin = tile.cells.front().key;
  return std::abs(key.x - origin.x) <= kReach && std::abs(key.y - origin.y) <= kReach &&
         std::abs(key.z - origin.z) <= kReach;
}

}  // namespace

std::vector<MapTile> map_tiles(const Cells& cells, std::span<const double> lambda_Bq,
                               std::span<const double> sensitivity_s) {
  std::vector<MapTile> tiles;
  for (std::size_t j = 0; j < cells.size(); ++j) {
    if (tiles.empty() || !fits(tiles.back(), cells.key(j))) {
      tiles.push_back({.cell_m = cells.cell_m(), .tile = static_cast<std::int32_t>(tiles.size())});
    }
    tiles.back().cells.push_back({.key = cells.key(j), .lambda_Bq = lambda_Bq[j], .sensitivity_s = sensitivity_s[j]});
  }
  for (MapTile& tile : tiles) tile.tiles = static_cast<std::int32_t>(tiles.size());
  return tiles;
}

}  // namespace comptonaut
