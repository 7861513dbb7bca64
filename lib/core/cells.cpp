// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <tuple>

#include "core/hash.h"

namespace comptonaut {
namespace {

std::int32_t voxel_index(double x_m, double voxel_m) { return static_cast<std::int32_t>(std::floor(x_m / voxel_m)); }

bool comes_before(const VoxelKey& a, const VoxelKey& b) { return std::tie(a.y, a.x, a.z) < std::tie(b.y, b.x, b.z); }

}  // namespace

double Area::diagonal_m() const { return std::hypot(x_max_m - x_min_m, y_max_m - y_min_m); }

VoxelKey voxel_at(const Eigen::Vector3d& p_W, double voxel_m) {
  return {voxel_index(p_W.x(), voxel_m), voxel_index(p_W.y(), voxel_m), voxel_index(p_W.z(), voxel_m)};
}

Cells::Cells(double cell_m, std::vector<Cell> cells) : cell_m_(cell_m), cells_(std::move(cells)) {
  if (!(cell_m > 0.0)) throw std::invalid_argument(fmt::format("cell_m is {}, must be positive", cell_m));
  const auto by_key = [](const Cell& a, const Cell& b) { return comes_before(a.key, b.key); };
  std::sort(cells_.begin(), cells_.end(), by_key);
  for (std::size_t j = 1; j < cells_.size(); ++j) {
    if (cells_[j].key == cells_[j - 1].key) {
      const VoxelKey key = cells_[j].key;
      throw std::invalid_argument(fmt::format("two cells share the voxel ({}, {}, {})", key.x, key.y, key.z));
    }
  }
  neighbour_start_.reserve(cells_.size() + 1);
  neighbours_.reserve(8 * cells_.size());
  for (const Cell& cell : cells_) {
    neighbour_start_.push_back(static_cast<std::uint32_t>(neighbours_.size()));
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        // All cells of one column stand together in the order, so one search finds its up to three neighbours.
        const Cell lowest{.key = {cell.key.x + dx, cell.key.y + dy, cell.key.z - 1}, .p_W = {}};
        for (auto it = std::lower_bound(cells_.begin(), cells_.end(), lowest, by_key);
             it != cells_.end() && it->key.x == lowest.key.x && it->key.y == lowest.key.y &&
             it->key.z <= cell.key.z + 1;
             ++it) {
          if (it->key != cell.key) neighbours_.push_back(static_cast<std::uint32_t>(it - cells_.begin()));
        }
      }
    }
  }
  neighbour_start_.push_back(static_cast<std::uint32_t>(neighbours_.size()));
}

std::optional<std::size_t> Cells::find(VoxelKey key) const {
  const auto it = std::lower_bound(cells_.begin(), cells_.end(), key,
                                   [](const Cell& cell, const VoxelKey& k) { return comes_before(cell.key, k); });
  if (it == cells_.end() || it->key != key) return std::nullopt;
  return static_cast<std::size_t>(it - cells_.begin());
}

std::span<const std::uint32_t> Cells::neighbours(std::size_t j) const {
  return {neighbours_.data() + neighbour_start_[j], neighbours_.data() + neighbour_start_[j + 1]};
}

std::uint64_t Cells::hash() const {
  Fnv1a hash;
  hash.add(cell_m_);
  for (const Cell& cell : cells_) {
    for (const double x : cell.p_W) hash.add(x);
  }
  return hash.value();
}

Area bounding_area(const Cells& cells) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  Area area{.x_min_m = kInfinite, .x_max_m = -kInfinite, .y_min_m = kInfinite, .y_max_m = -kInfinite};
  const double half_m = 0.5 * cells.cell_m();
  for (std::size_t j = 0; j < cells.size(); ++j) {
    const Eigen::Vector3d& p_W = cells.p_W(j);
    area.x_min_m = std::min(area.x_min_m, p_W.x() - half_m);
    area.x_max_m = std::max(area.x_max_m, p_W.x() + half_m);
    area.y_min_m = std::min(area.y_min_m, p_W.y() - half_m);
    area.y_max_m = std::max(area.y_max_m, p_W.y() + half_m);
  }
  return area;
}

Cells flat_cells(const Area& area, double cell_m, double z_m) {
  const bool valid = std::isfinite(area.diagonal_m()) && area.x_max_m > area.x_min_m && area.y_max_m > area.y_min_m;
  if (!valid || !(cell_m > 0.0) || !std::isfinite(z_m)) {
    throw std::invalid_argument(fmt::format("no cells: area x {}..{} m, y {}..{} m, cell {} m, height {} m",
                                            area.x_min_m, area.x_max_m, area.y_min_m, area.y_max_m, cell_m, z_m));
  }
  const double count = (area.x_max_m - area.x_min_m) * (area.y_max_m - area.y_min_m) / (cell_m * cell_m);
  if (count > kMaxCells) {
    throw std::invalid_argument(fmt::format("an area of {} x {} m has {:.3g} cells of {} m, {:.3g} are the most",
                                            area.x_max_m - area.x_min_m, area.y_max_m - area.y_min_m, count, cell_m,
                                            kMaxCells));
  }
  const auto first = [cell_m](double min_m) { return static_cast<std::int32_t>(std::ceil(min_m / cell_m - 0.5)); };
  const auto last = [cell_m](double max_m) { return static_cast<std::int32_t>(std::floor(max_m / cell_m - 0.5)); };
  // The ground is the top of its voxel, so a height on a voxel border belongs to the voxel below.
  const auto key_z = static_cast<std::int32_t>(std::ceil(z_m / cell_m)) - 1;
  std::vector<Cells::Cell> cells;
  cells.reserve(static_cast<std::size_t>(count));
  for (std::int32_t y = first(area.y_min_m); y <= last(area.y_max_m); ++y) {
    for (std::int32_t x = first(area.x_min_m); x <= last(area.x_max_m); ++x) {
      cells.push_back({.key = {x, y, key_z}, .p_W = {(x + 0.5) * cell_m, (y + 0.5) * cell_m, z_m}});
    }
  }
  return Cells(cell_m, std::move(cells));
}

}  // namespace comptonaut
