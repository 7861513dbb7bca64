// SPDX-License-Identifier: BSD-3-Clause
#include "report/map_history.h"

#include <cmath>
#include <functional>
#include <limits>

namespace comptonaut {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// The smallest rectangle of both; empty where `grid` was empty is the one column.
MapGrid united(const MapGrid& grid, std::int64_t x, std::int64_t y) {
  if (grid.size() == 0) {
    return {grid.cell_m, static_cast<std::int32_t>(x), static_cast<std::int32_t>(y), 1, 1};
  }
  const std::int64_t x_min = std::min<std::int64_t>(grid.x0, x), y_min = std::min<std::int64_t>(grid.y0, y);
  const std::int64_t x_end = std::max(std::int64_t{grid.x0} + grid.nx, x + 1);
  const std::int64_t y_end = std::max(std::int64_t{grid.y0} + grid.ny, y + 1);
  const std::int64_t nx = x_end - x_min, ny = y_end - y_min;
  if (nx > kMaxMapColumns || ny > kMaxMapColumns || nx * ny > kMaxMapColumns) return grid;
  return {grid.cell_m, static_cast<std::int32_t>(x_min), static_cast<std::int32_t>(y_min),
          static_cast<std::int32_t>(nx), static_cast<std::int32_t>(ny)};
}

/// The cells of the highest sensitivity, as many as `coverage` says (and those that equal the last of them).
std::vector<bool> searched_cells(const std::vector<float>& sensitivity_s, double coverage) {
  std::vector<float> sorted;
  std::copy_if(sensitivity_s.begin(), sensitivity_s.end(), std::back_inserter(sorted),
               [](float s) { return !std::isnan(s); });
  std::vector<bool> searched(sensitivity_s.size(), false);
  const auto n =
      static_cast<std::size_t>(std::lround(std::clamp(coverage, 0.0, 1.0) * static_cast<double>(sorted.size())));
  if (n == 0) return searched;
  const auto last = sorted.begin() + static_cast<std::ptrdiff_t>(n) - 1;
  std::nth_element(sorted.begin(), last, sorted.end(), std::greater<>());
  for (std::size_t j = 0; j < searched.size(); ++j) searched[j] = sensitivity_s[j] >= *last;
  return searched;
}

}  // namespace

std::uint8_t lambda_level(double lambda_Bq) {
  if (!(lambda_Bq >= 1.0)) return 0;
  return static_cast<std::uint8_t>(std::min(254.0, 1.0 + std::round(kLevelsPerDecade * std::log10(lambda_Bq))));
}

void MapHistory::add(const MapTile& tile) {
  if (open_ && tile.utime < utime_) {
    ++record_.late_tiles;
    return;
  }
  if (record_.grid.cell_m == 0.0) {
    record_.grid.cell_m = tile.cell_m;
    record_.nuclide = tile.nuclide;
  }
  if (tile.cell_m != record_.grid.cell_m || tile.nuclide != record_.nuclide) {
    record_.cells_left_out += static_cast<std::int64_t>(tile.cells.size());
    return;
  }
  utime_ = tile.utime;
  open_ = true;
  for (const MapCell& cell : tile.cells) put(cell, tile.utime);
}

void MapHistory::put(const MapCell& cell, Utime utime) {
  if (!grow_to(cell.key.x, cell.key.y)) {
    ++record_.cells_left_out;
    return;
  }
  const std::size_t j = record_.grid.index(cell.key.x, cell.key.y);
  const auto lambda = static_cast<float>(cell.lambda_Bq), sensitivity = static_cast<float>(cell.sensitivity_s);
  const bool above_another = updated_[j] == utime && !std::isnan(record_.lambda_Bq[j]);
  record_.lambda_Bq[j] = above_another ? std::max(record_.lambda_Bq[j], lambda) : lambda;
  record_.sensitivity_s[j] = above_another ? std::max(record_.sensitivity_s[j], sensitivity) : sensitivity;
  updated_[j] = utime;
}

bool MapHistory::grow_to(std::int64_t x, std::int64_t y) {
  const MapGrid before = record_.grid;
  if (before.contains(x, y)) return true;
  const MapGrid after = united(before, x, y);
  if (after == before) return false;
  record_.lambda_Bq = regrid(record_.lambda_Bq, before, after, kNaN);
  record_.sensitivity_s = regrid(record_.sensitivity_s, before, after, kNaN);
  updated_ = regrid(updated_, before, after, Utime{0});
  record_.grid = after;
  return true;
}

void MapHistory::close_frame(double coverage) {
  if (!open_) return;
  MapFrame frame{.utime = utime_,
                 .grid = record_.grid,
                 .lambda_level = {},
                 .searched = searched_cells(record_.sensitivity_s, coverage)};
  frame.lambda_level.reserve(record_.lambda_Bq.size());
  for (const float lambda : record_.lambda_Bq) {
    frame.lambda_level.push_back(std::isnan(lambda) ? kNoCell : lambda_level(lambda));
  }
  record_.frames.push_back(std::move(frame));
}

MapRecord MapHistory::finish() && { return std::move(record_); }

}  // namespace comptonaut
