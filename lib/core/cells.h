// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace comptonaut {

/// A rectangle of the world's horizontal plane, m.
struct Area {
  double x_min_m = 0.0;
  double x_max_m = 0.0;
  double y_min_m = 0.0;
  double y_max_m = 0.0;

  [[nodiscard]] bool contains(double x_m, double y_m) const {
    return x_m >= x_min_m && x_m <= x_max_m && y_m >= y_min_m && y_m <= y_max_m;
  }
  [[nodiscard]] double diagonal_m() const;
  bool operator==(const Area&) const = default;
};

/// Which voxel of the world: floor(p_W / voxel edge) along each axis.
struct VoxelKey {
  std::int32_t x = 0;
  std::int32_t y = 0;
  std::int32_t z = 0;

  auto operator<=>(const VoxelKey&) const = default;
};

[[nodiscard]] VoxelKey voxel_at(const Eigen::Vector3d& p_W, double voxel_m);

/// Where gamma sources may lie: the cells of the terrain's surface, each the surface of one voxel. Their order is that
/// of their keys (y, then x, then z), so that it depends on nothing but the set. Immutable.
class Cells {
 public:
  /// One cell: its voxel and its centre on the surface, frame W.
  struct Cell {
    VoxelKey key;
    Eigen::Vector3d p_W;
  };

  /// Throws std::invalid_argument unless cell_m is positive and no two cells share a key.
  Cells(double cell_m, std::vector<Cell> cells);

  [[nodiscard]] std::size_t size() const { return cells_.size(); }
  [[nodiscard]] double cell_m() const { return cell_m_; }
  [[nodiscard]] VoxelKey key(std::size_t j) const { return cells_[j].key; }
  [[nodiscard]] const Eigen::Vector3d& p_W(std::size_t j) const { return cells_[j].p_W; }
  [[nodiscard]] std::optional<std::size_t> find(VoxelKey key) const;

  /// The cells whose voxels touch that of cell j, itself left out: eight inside flat ground.
  [[nodiscard]] std::span<const std::uint32_t> neighbours(std::size_t j) const;

  /// Of the cells' edge and centres, bit for bit: machines that have the same terrain have the same hash.
  [[nodiscard]] std::uint64_t hash() const;

 private:
  double cell_m_;
  std::vector<Cell> cells_;
  std::vector<std::uint32_t> neighbour_start_;
  std::vector<std::uint32_t> neighbours_;
};

/// The smallest area that holds all cells to their edges; of no cells it has no inside.
[[nodiscard]] Area bounding_area(const Cells& cells);

/// What fits the memory of a small computer: a square of 2 km at 0.5 m.
inline constexpr double kMaxCells = 2e7;

/// Flat ground at height z_m: every voxel column of edge cell_m whose centre lies in the area.
/// Throws std::invalid_argument unless the area and cell_m are positive and finite, and for more than kMaxCells.
[[nodiscard]] Cells flat_cells(const Area& area, double cell_m, double z_m = 0.0);

}  // namespace comptonaut
