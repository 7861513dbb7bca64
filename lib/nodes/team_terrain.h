// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/cells.h"
#include "nodes/status.h"
#include "nodes/terrain_tile.h"
#include "world/world.h"

namespace comptonaut {

/// The terrain as the team knows it: the map of the start, and what its MAVs' range points say since. Where two MAVs
/// disagree about a voxel the later tile counts, of one tick by (utime, sender). A function of the tiles that it
/// folded, tick by tick.
class TeamTerrain {
 public:
  /// `cells`: where sources may lie in `world`, as far as they are in `area`.
  TeamTerrain(World world, Cells cells, const Area& area);

  [[nodiscard]] const World& world() const { return world_; }
  /// Stays where it is when it changes.
  [[nodiscard]] const Cells& cells() const { return cells_; }
  [[nodiscard]] std::uint64_t hash() const { return hash_; }

  /// The tiles of one tick, in their order. True: obstacles or cells are otherwise than before.
  [[nodiscard]] bool fold(std::span<const TerrainTile> tiles);

  [[nodiscard]] std::vector<Counter> counters() const;

 private:
  [[nodiscard]] std::vector<VoxelChange> news(std::span<const TerrainTile> tiles);

  World world_;
  Cells cells_;
  Area area_;
  std::uint64_t hash_;
  std::int64_t tiles_ = 0, voxels_changed_ = 0, rebuilds_ = 0;
};

}  // namespace comptonaut
