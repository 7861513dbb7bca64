// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/batch_key.h"
#include "core/cells.h"
#include "core/time.h"

namespace comptonaut {

/// The map's value at one cell.
struct MapCell {
  VoxelKey key;
  double lambda_Bq = 0.0;      ///< activity of the cell; "joint": beside the point sources
  double sensitivity_s = 0.0;  ///< s_j: expected events per Bq: pairs ("mlem"), or pairs and singles ("joint")

  bool operator==(const MapCell&) const = default;
};

/// Some cells of the map at one tick: what fits one datagram. Means something alone.
struct MapTile {
  std::int64_t mission = 0;
  Utime utime = 0;
  std::string nuclide;
  double cell_m = 0.0;
  std::int32_t tile = 0;
  std::int32_t tiles = 0;
  std::vector<MapCell> cells;  ///< keys within 127 voxels of the first one
};

inline constexpr std::size_t kMaxCellsPerTile = 90;

/// How clear one cell is.
struct ClearanceCell {
  VoxelKey key;
  double limit_Bq = 0.0;  ///< at most kNothingKnown_Bq

  bool operator==(const ClearanceCell&) const = default;
};

inline constexpr double kNothingKnown_Bq = 1e18;

/// As MapTile: above which activity cells are clear of another source than those reported.
struct ClearanceTile {
  std::int64_t mission = 0;
  Utime utime = 0;
  std::string nuclide;
  double chance = 0.05;  ///< of a source stronger than the limit
  double cell_m = 0.0;
  std::int32_t tile = 0;
  std::int32_t tiles = 0;
  std::vector<ClearanceCell> cells;
};

/// Who leads, and what its state at this tick is made of.
struct CoordinatorState {
  std::int64_t mission = 0;
  Utime utime = 0;          ///< tick: whole seconds of data time
  std::int32_t sender = 0;  ///< machine that leads: MAV number, 0 for the ground station
  std::int64_t term = 0;
  std::int64_t lease_us = 0;  ///< the lead ends this long after the message unless renewed
  std::uint64_t terrain_hash = 0;
  Basis basis;
  std::uint64_t lambda_hash = 0;  ///< of the map's doubles: equal states have equal hashes
  std::int64_t cones = 0;         ///< rows in use
  std::int64_t viewpoints = 0;    ///< folded in
};

}  // namespace comptonaut
