// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <vector>

#include "world/world.h"

namespace comptonaut {

/// How a file of heights lies in the world.
struct HeightmapFrame {
  double metres_per_pixel = 0.5;
  double x_min_m = 0.0, y_min_m = 0.0;  ///< its south-western corner in W; its first row lies in the north
  double z_min_m = 0.0, z_max_m = 1.0;  ///< height of black and of white; of a picture alone
};

/// Heights of the terrain in squares, without overhangs.
struct Heightmap {
  HeightmapFrame frame;
  int columns = 0, rows = 0;
  std::vector<double> z_m;  ///< row by row from the north, from west to east; NaN: a hole, nobody knows

  /// Of the square around (x, y); nullopt in a hole and outside.
  [[nodiscard]] std::optional<double> at(double x_m, double y_m) const;
};

/// A picture (PNG of 8 or 16 bits; colours count as their brightness, what is transparent is a hole), or a text grid:
/// a line per row, heights in m between spaces, tabs or commas, "nan" for a hole, "#" begins a comment. At most 1e8
/// squares. Throws std::runtime_error that names the file, the line where there is one, and what is wrong.
[[nodiscard]] Heightmap load_heightmap(const std::filesystem::path& file, const HeightmapFrame& frame);

/// A world that is occupied up to the heights, free above as far as `free_m` over the highest, unknown in holes and
/// around. A voxel counts by its centre. Throws std::invalid_argument as build_octree does, or where all is a hole.
[[nodiscard]] World world_of(const Heightmap& map, double voxel_m, double free_m);

}  // namespace comptonaut
