// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>

#include "world/world.h"

namespace comptonaut {

class Config;

/// Where the team's map comes from.
struct TerrainConfig {
  std::filesystem::path octomap;                       ///< obstacles and terrain; empty: flat ground without obstacles
  UnknownSpace unknown_space = UnknownSpace::kClosed;  ///< of the octomap
  std::optional<World> heightmap = std::nullopt;       ///< the world of a heightmap instead
  double ground_m = 0.0;                               ///< height of flat ground in W
  double voxel_m = 0.5;                                ///< edge of the voxels that range points find on flat ground
};

/// The keys `octomap`, `unknown_space`, `heightmap`, `ground_m` and `voxel_m` of a file. Throws ConfigError.
[[nodiscard]] TerrainConfig read_terrain_config(Config& config);

/// The world of a section `heightmap`: the file and how it lies. Throws ConfigError.
[[nodiscard]] World read_heightmap(Config& config);

/// Of the octomap, else of the heightmap, else flat ground. Throws std::runtime_error that names the file.
[[nodiscard]] World load_world(const TerrainConfig& config);

}  // namespace comptonaut
