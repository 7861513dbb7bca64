// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>
#include <optional>
#include <stdexcept>

#include "bus/valid.h"
#include "bus/wire.h"
#include "core/cells.h"

// What messages of map tiles have in common: header and cells' keys, these as bytes relative to the first one's.
namespace comptonaut {

inline bool near(const VoxelKey& key, const VoxelKey& origin) {
  const auto fits = [](std::int32_t voxel, std::int32_t first) { return std::abs(std::int64_t{voxel} - first) <= 127; };
  return fits(key.x, origin.x) && fits(key.y, origin.y) && fits(key.z, origin.z);
}

/// All but what tiles say of cells. Throws std::invalid_argument where they lie too far apart.
template <class Message, class Tile>
[[nodiscard]] Message tile_to_msg(const Tile& tile) {
  const VoxelKey origin = tile.cells.empty() ? VoxelKey{} : tile.cells.front().key;
  Message m;
  m.mission = tile.mission;
  m.utime = tile.utime;
  m.nuclide = clean_text(tile.nuclide);
  m.cell_m = tile.cell_m;
  m.tile = tile.tile;
  m.tiles = tile.tiles;
  m.origin[0] = origin.x;
  m.origin[1] = origin.y;
  m.origin[2] = origin.z;
  m.n = static_cast<std::int32_t>(tile.cells.size());
  for (const auto& cell : tile.cells) {
    if (!near(cell.key, origin)) throw std::invalid_argument("map tile with a cell over 127 voxels from its first one");
    m.dx.push_back(static_cast<std::int8_t>(cell.key.x - origin.x));
    m.dy.push_back(static_cast<std::int8_t>(cell.key.y - origin.y));
    m.dz.push_back(static_cast<std::int8_t>(cell.key.z - origin.z));
  }
  return m;
}

/// nullopt where the origin is out of range.
template <class Tile, class Message>
[[nodiscard]] std::optional<Tile> tile_from_msg(const Message& m) {
  constexpr std::int32_t kMaxVoxel = 100'000'000;
  for (const std::int32_t index : m.origin) {
    if (index < -kMaxVoxel || index > kMaxVoxel) return {};
  }
  Tile tile;
  tile.mission = m.mission;
  tile.utime = m.utime;
  tile.nuclide = m.nuclide;
  tile.cell_m = m.cell_m;
  tile.tile = m.tile;
  tile.tiles = m.tiles;
  tile.cells.resize(m.dx.size());
  for (std::size_t i = 0; i < tile.cells.size(); ++i) {
    tile.cells[i].key = {m.origin[0] + m.dx[i], m.origin[1] + m.dy[i], m.origin[2] + m.dz[i]};
  }
  return tile;
}

template <class Tile>
[[nodiscard]] bool valid_tile(const Tile& tile) {
  for (const auto& cell : tile.cells) {
    if (!near(cell.key, tile.cells.front().key)) return false;
  }
  return tile.mission >= 0 && valid_utime(tile.utime) && valid_text(tile.nuclide) && tile.cell_m > 0.0 &&
         tile.cell_m <= kMaxCoordinate && tile.tile >= 0 && tile.tile < tile.tiles;
}

}  // namespace comptonaut
