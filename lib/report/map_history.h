// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "core/time.h"
#include "nodes/map_tile.h"

namespace comptonaut {

/// A rectangle of columns of the world: voxel indices x0 .. x0 + nx - 1, y0 .. y0 + ny - 1, row by row (x fastest).
struct MapGrid {
  double cell_m = 0.0;
  std::int32_t x0 = 0;
  std::int32_t y0 = 0;
  std::int32_t nx = 0;
  std::int32_t ny = 0;

  [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny); }
  [[nodiscard]] bool contains(std::int64_t x, std::int64_t y) const {
    return x >= x0 && x < std::int64_t{x0} + nx && y >= y0 && y < std::int64_t{y0} + ny;
  }
  [[nodiscard]] std::size_t index(std::int64_t x, std::int64_t y) const {
    return static_cast<std::size_t>(y - y0) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(x - x0);
  }
  bool operator==(const MapGrid&) const = default;
};

/// A map no larger than this is kept: 2000 x 2000 columns. Cells beyond are left out and counted.
inline constexpr std::int64_t kMaxMapColumns = 4'000'000;

/// Levels of lambda on a logarithmic scale, 20 a decade from 1 Bq up. 0: less.
inline constexpr int kLevelsPerDecade = 20;
inline constexpr std::uint8_t kNoCell = 255;
[[nodiscard]] std::uint8_t lambda_level(double lambda_Bq);

/// The map at one tick.
struct MapFrame {
  Utime utime = 0;
  MapGrid grid;
  std::vector<std::uint8_t> lambda_level;  ///< kNoCell where there is no cell
  std::vector<bool> searched;              ///< the share `coverage` of the cells, those of the highest sensitivity
};

struct MapRecord {
  std::string nuclide;
  MapGrid grid;                      ///< holds every frame's
  std::vector<float> lambda_Bq;      ///< at the end; NaN where there is no cell
  std::vector<float> sensitivity_s;  ///< at the end
  std::vector<MapFrame> frames;      ///< by time
  std::int64_t cells_left_out = 0;   ///< beyond kMaxMapColumns, of another cell size or another nuclide
  std::int64_t late_tiles = 0;       ///< older than a frame that was closed, left out
};

/// Puts tiles together. A tile means something alone: what no tile of a tick tells stays as it was. Of cells above each
/// other the highest lambda shows.
class MapHistory {
 public:
  /// Whether the tile opens a new tick, so that close_frame() is due before add().
  [[nodiscard]] bool opens_frame(const MapTile& tile) const { return open_ && tile.utime > utime_; }
  [[nodiscard]] Utime frame_utime() const { return utime_; }
  void add(const MapTile& tile);
  /// Keeps the map as it is now; `coverage` is the share of cells that count as searched.
  void close_frame(double coverage);
  [[nodiscard]] MapRecord finish() &&;

 private:
  void put(const MapCell& cell, Utime utime);
  [[nodiscard]] bool grow_to(std::int64_t x, std::int64_t y);

  MapRecord record_;
  std::vector<Utime> updated_;  ///< per column
  Utime utime_ = 0;
  bool open_ = false;
};

/// `values` of a grid as those of a larger grid that holds it; the rest is `fill`.
template <class T>
[[nodiscard]] std::vector<T> regrid(const std::vector<T>& values, const MapGrid& from, const MapGrid& to, T fill) {
  std::vector<T> result(to.size(), fill);
  for (std::int32_t row = 0; row < from.ny; ++row) {
    const auto source = values.begin() + static_cast<std::ptrdiff_t>(from.index(from.x0, from.y0 + row));
    const auto target = result.begin() + static_cast<std::ptrdiff_t>(to.index(from.x0, from.y0 + row));
    std::copy(source, source + from.nx, target);
  }
  return result;
}

}  // namespace comptonaut
