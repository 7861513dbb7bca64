// SPDX-License-Identifier: BSD-3-Clause
#include "world/wall_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace comptonaut {
namespace {

constexpr double kStep = 1.5;  // cells: a higher one is a wall
constexpr std::array<VoxelKey, 4> kSides = {{{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}}};

Eigen::Vector3d centre_W(const VoxelKey& key, double cell_m) {
  return cell_m * Eigen::Vector3d(key.x + 0.5, key.y + 0.5, key.z + 0.5);
}

/// Height of the highest ground beside a cell.
double highest_beside_m(const World& world, const Eigen::Vector3d& p_W, double cell_m) {
  double highest_m = -std::numeric_limits<double>::infinity();
  for (const VoxelKey& side : kSides) {
    const auto height_m = world.ground_height_m(p_W.x() + cell_m * side.x, p_W.y() + cell_m * side.y);
    highest_m = std::max(highest_m, height_m.value_or(highest_m));
  }
  return highest_m;
}

}  // namespace

std::vector<Cells::Cell> wall_cells(const World& world, const Cells& ground) {
  const double cell_m = ground.cell_m();
  std::vector<Cells::Cell> cells;
  for (std::size_t j = 0; j < ground.size(); ++j) {
    const double top_m = highest_beside_m(world, ground.p_W(j), cell_m);
    if (top_m <= ground.p_W(j).z() + kStep * cell_m) continue;
    VoxelKey key = ground.key(j);
    for (++key.z; cell_m * key.z < top_m; ++key.z) {
      const Eigen::Vector3d middle_W = centre_W(key, cell_m);
      if (world.at(middle_W) != Occupancy::kFree) continue;
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      int walls = 0;
      for (const VoxelKey& side : kSides) {
        const Eigen::Vector3d towards(side.x, side.y, 0.0);
        if (world.at(middle_W + cell_m * towards) != Occupancy::kOccupied) continue;
        sum += (0.5 * cell_m - kBeforeWall_m) * towards;
        ++walls;
      }
      if (walls > 0) cells.push_back({.key = key, .p_W = middle_W + sum / walls});
    }
  }
  return cells;
}

}  // namespace comptonaut
