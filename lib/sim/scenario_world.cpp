// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scenario_world.h"

#include <fmt/format.h>

#include <optional>
#include <stdexcept>

#include "nodes/terrain_config.h"

namespace comptonaut {
namespace {

constexpr double kBoxFar_m = 1e5;
constexpr double kBoxHigh_m = 1000.0;
constexpr int kGroundVoxels = 2;  // of ground below the surface

Box read_box(Config& config) {
  Box box;
  config.require("x_min_m", box.min_W.x(), Range{-kBoxFar_m, kBoxFar_m});
  config.require("x_max_m", box.max_W.x(), Range{box.min_W.x(), kBoxFar_m});
  config.require("y_min_m", box.min_W.y(), Range{-kBoxFar_m, kBoxFar_m});
  config.require("y_max_m", box.max_W.y(), Range{box.min_W.y(), kBoxFar_m});
  config.read("z_min_m", box.min_W.z(), {.min = 0.0, .max = kBoxHigh_m});
  config.require("z_max_m", box.max_W.z(), Range{box.min_W.z(), kBoxHigh_m});
  return box;
}

World of_boxes(Config& config, const std::vector<Box>& boxes, const Area& area) {
  double voxel_m = 0.5, ceiling_m = 15.0;
  config.read("voxel_m", voxel_m, {.min = 0.05, .max = 10.0});
  config.read("ceiling_m", ceiling_m, {.min = 1.0, .max = kBoxHigh_m});
  const Box extent{.min_W = {area.x_min_m - kWorldMargin_m, area.y_min_m - kWorldMargin_m, -kGroundVoxels * voxel_m},
                   .max_W = {area.x_max_m + kWorldMargin_m, area.y_max_m + kWorldMargin_m, ceiling_m}};
  return World::of_boxes(boxes, extent, voxel_m);
}

}  // namespace

World read_world(Config& config, const Area& area) {
  std::filesystem::path octomap;
  std::vector<Box> boxes;
  config.read("octomap", octomap);
  std::optional<World> terrain;
  config.section("heightmap", [&](Config& section) { terrain = read_heightmap(section); });
  config.each("boxes", [&](Config& box) { boxes.push_back(read_box(box)); });
  if ((octomap.empty() ? 0 : 1) + (boxes.empty() ? 0 : 1) + (terrain ? 1 : 0) != 1) {
    throw config.error("octomap", "either the file of an octomap, a heightmap or boxes must be given, one of them");
  }
  if (terrain) return *terrain;
  const char* key = octomap.empty() ? "boxes" : "octomap";
  try {
    return octomap.empty() ? of_boxes(config, boxes, area) : World::load(octomap);
  } catch (const ConfigError&) {
    throw;
  } catch (const std::exception& error) {
    throw config.error(key, error.what());
  }
}

}  // namespace comptonaut
