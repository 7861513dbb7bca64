// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/team_terrain.h"

#include <algorithm>
#include <map>
#include <utility>

namespace comptonaut {

TeamTerrain::TeamTerrain(World world, Cells cells, const Area& area)
    : world_(std::move(world)), cells_(std::move(cells)), area_(area), hash_(cells_.hash()) {}

/// What the tiles say last of each voxel, where it is otherwise than in the map.
std::vector<VoxelChange> TeamTerrain::news(std::span<const TerrainTile> tiles) {
  std::map<VoxelKey, Occupancy> last;
  for (const TerrainTile& tile : tiles) {
    for (const auto& [voxel, occupancy] : tile.voxels) last[voxel] = occupancy;
  }
  std::vector<VoxelChange> changes;
  for (const auto& [voxel, occupancy] : last) {
    if (world_.at(centre_of(voxel, world_.voxel_m())) != occupancy) changes.push_back({voxel, occupancy});
  }
  return changes;
}

bool TeamTerrain::fold(std::span<const TerrainTile> tiles) {
  tiles_ += std::ssize(tiles);
  const std::vector<VoxelChange> changes = news(tiles);
  if (changes.empty()) return false;
  const bool obstacles = std::ranges::any_of(changes, [&](const VoxelChange& change) {
    const bool was = world_.at(centre_of(change.voxel, world_.voxel_m())) == Occupancy::kOccupied;
    return was || change.occupancy == Occupancy::kOccupied;
  });
  voxels_changed_ += std::ssize(changes);
  world_ = world_.with(changes);
  Cells cells = world_.surface_cells(area_, cells_.cell_m());
  const std::uint64_t hash = cells.hash();
  const bool surface = hash != hash_ && cells.size() > 0;
  if (surface) {
    cells_ = std::move(cells);
    hash_ = hash;
  }
  if (obstacles || surface) ++rebuilds_;
  return obstacles || surface;
}

std::vector<Counter> TeamTerrain::counters() const {
  return {{"tiles_folded", tiles_}, {"voxels_changed", voxels_changed_}, {"terrain_rebuilds", rebuilds_}};
}

}  // namespace comptonaut
