// SPDX-License-Identifier: BSD-3-Clause
#include "world/footprint.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace comptonaut {
namespace {

constexpr double kStepMax = 1.5;       // of a slope, in edges of a column
constexpr double kHighest_m = 1000.0;  // above the ground
constexpr double kSome_m = 1e-3;       // of occupied space
constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

double column_edge_m(const World& world, const Area& area) {
  const double long_m = std::max(area.x_max_m - area.x_min_m, area.y_max_m - area.y_min_m);
  return world.voxel_m() * std::max(1.0, std::ceil(long_m / (world.voxel_m() * kFootprintColumns)));
}

/// The columns, and then their neighbours that `enter(from, to)` agrees to, nearest first.
template <typename Enter>
std::vector<std::size_t> spread(const Cells& columns, std::vector<std::size_t> list, const Enter& enter) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::size_t from = list[i];
    for (const std::size_t to : columns.neighbours(from)) {
      if (enter(from, to)) list.push_back(to);
    }
  }
  return list;
}

/// The largest part of a surface without steps.
std::vector<std::size_t> largest_part(const Cells& columns, const std::vector<double>& surface_m) {
  std::vector<std::size_t> largest;
  std::vector<bool> seen(columns.size(), false);
  const auto level = [&](std::size_t from, std::size_t to) {
    if (seen[to] || !(std::abs(surface_m[to] - surface_m[from]) <= kStepMax * columns.cell_m())) return false;
    seen[to] = true;
    return true;
  };
  for (std::size_t j = 0; j < columns.size(); ++j) {
    if (seen[j] || std::isnan(surface_m[j])) continue;
    seen[j] = true;
    std::vector<std::size_t> part = spread(columns, {j}, level);
    if (part.size() > largest.size()) largest = std::move(part);
  }
  return largest;
}

/// The ground's height in each column, also below what stands on it; not known where the world has no ground.
std::vector<double> ground_heights_m(const World& world, const Cells& columns) {
  std::vector<double> surface_m, ground_m(columns.size(), kNotKnown);
  for (std::size_t j = 0; j < columns.size(); ++j) {
    surface_m.push_back(world.ground_height_m(columns.p_W(j).x(), columns.p_W(j).y()).value_or(kNotKnown));
  }
  const std::vector<std::size_t> ground = largest_part(columns, surface_m);
  for (const std::size_t j : ground) ground_m[j] = surface_m[j];
  (void)spread(columns, ground, [&](std::size_t from, std::size_t to) {
    if (!std::isnan(ground_m[to])) return false;
    ground_m[to] = ground_m[from];
    return true;
  });
  return ground_m;
}

/// Columns, ends excluded.
struct Rectangle {
  std::int32_t x_begin, x_end, y_begin, y_end;
};

/// Runs of each row, grown together where the next row has the same run. Keys in the order of Cells.
std::vector<Rectangle> rectangles(const std::vector<VoxelKey>& keys) {
  std::vector<Rectangle> runs, merged;
  for (const VoxelKey& key : keys) {
    if (!runs.empty() && runs.back().y_begin == key.y && runs.back().x_end == key.x) {
      ++runs.back().x_end;
    } else {
      runs.push_back({key.x, key.x + 1, key.y, key.y + 1});
    }
  }
  std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> last_of;  // rectangle with such a run
  for (const Rectangle& run : runs) {
    const auto [it, is_new] = last_of.try_emplace({run.x_begin, run.x_end}, merged.size());
    if (!is_new && merged[it->second].y_end == run.y_begin) {
      merged[it->second].y_end = run.y_end;
    } else {
      it->second = merged.size();
      merged.push_back(run);
    }
  }
  return merged;
}

}  // namespace

std::vector<Area> footprint(const World& world, const Area& area) {
  if (world.is_flat()) return {};
  const Cells columns = flat_cells(area, column_edge_m(world, area));
  const double edge_m = columns.cell_m();
  const std::vector<double> ground_m = ground_heights_m(world, columns);
  std::vector<VoxelKey> standing;
  for (std::size_t j = 0; j < columns.size(); ++j) {
    if (std::isnan(ground_m[j])) continue;
    Eigen::Vector3d low_W = columns.p_W(j), high_W = low_W;
    low_W.z() = ground_m[j] + kStepMax * edge_m;
    high_W.z() = ground_m[j] + kHighest_m;
    if (world.occupied_m(low_W, high_W, kSome_m) > kSome_m) standing.push_back(columns.key(j));
  }
  std::vector<Area> areas;
  for (const Rectangle& r : rectangles(standing)) {
    areas.push_back({.x_min_m = std::max(area.x_min_m, edge_m * r.x_begin),
                     .x_max_m = std::min(area.x_max_m, edge_m * r.x_end),
                     .y_min_m = std::max(area.y_min_m, edge_m * r.y_begin),
                     .y_max_m = std::min(area.y_max_m, edge_m * r.y_end)});
  }
  return areas;
}

}  // namespace comptonaut
