// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/terrain_config.h"

#include "config/config.h"
#include "world/heightmap.h"

namespace comptonaut {

TerrainConfig read_terrain_config(Config& config) {
  TerrainConfig terrain;
  config.read("octomap", terrain.octomap);
  std::string unknown_space = "closed";
  config.read("unknown_space", unknown_space, {"closed", "free"});
  if (unknown_space == "free") terrain.unknown_space = UnknownSpace::kFree;
  config.section("heightmap", [&](Config& section) { terrain.heightmap = read_heightmap(section); });
  if (terrain.heightmap && !terrain.octomap.empty()) {
    throw config.error("heightmap", "is not allowed beside an octomap, must be left out");
  }
  config.read("ground_m", terrain.ground_m, {.min = -1e4, .max = 1e4});
  config.read("voxel_m", terrain.voxel_m, {.min = 0.05, .max = 10.0});
  return terrain;
}

World read_heightmap(Config& config) {
  std::filesystem::path file;
  HeightmapFrame frame;
  double voxel_m = 0.5, free_m = 15.0;
  config.require("file", file);
  config.require("metres_per_pixel", frame.metres_per_pixel, Range{0.01, 100.0});
  config.read("x_min_m", frame.x_min_m, {.min = -1e5, .max = 1e5});
  config.read("y_min_m", frame.y_min_m, {.min = -1e5, .max = 1e5});
  config.read("z_min_m", frame.z_min_m, {.min = -1e4, .max = 1e4});
  config.read("z_max_m", frame.z_max_m, {.min = frame.z_min_m, .max = 1e4});
  config.read("voxel_m", voxel_m, {.min = 0.05, .max = 10.0});
  config.read("free_m", free_m, {.min = 1.0, .max = 1000.0});
  try {
    return world_of(load_heightmap(file, frame), voxel_m, free_m);
  } catch (const std::exception& error) {
    throw config.error("file", error.what());
  }
}

World load_world(const TerrainConfig& config) {
  if (!config.octomap.empty()) return World::load(config.octomap, config.unknown_space);
  return config.heightmap ? *config.heightmap : World::flat(config.ground_m, config.voxel_m);
}

}  // namespace comptonaut
