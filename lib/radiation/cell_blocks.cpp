// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/cell_blocks.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace comptonaut {
namespace {

constexpr std::int32_t kTile = 4;  // cells along the edge of a block of flat ground

/// Tile by tile; within a tile as cells are.
std::vector<std::uint32_t> in_tiles(const Cells& cells) {
  std::int32_t x_min = 0, y_min = 0;
  for (std::size_t j = 0; j < cells.size(); ++j) {
    x_min = j == 0 ? cells.key(j).x : std::min(x_min, cells.key(j).x);
    y_min = j == 0 ? cells.key(j).y : std::min(y_min, cells.key(j).y);
  }
  const auto tile = [&](std::uint32_t j) {
    return std::tuple((cells.key(j).y - y_min) / kTile, (cells.key(j).x - x_min) / kTile, j);
  };
  std::vector<std::uint32_t> order(cells.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) { return tile(i) < tile(j); });
  return order;
}

}  // namespace

CellBlocks::CellBlocks(const Cells& all) : size(all.size()), cells(in_tiles(all)) {
  if (size == 0) return;
  cells.resize(padded(size), cells.back());
  for (std::size_t first = 0; first < cells.size(); first += kBlock) {
    Eigen::Vector3d low_W = all.p_W(cells[first]), high_W = low_W;
    for (std::size_t i = 0; i < kBlock; ++i) {
      low_W = low_W.cwiseMin(all.p_W(cells[first + i]));
      high_W = high_W.cwiseMax(all.p_W(cells[first + i]));
    }
    const Eigen::Vector3d middle_W = 0.5 * (low_W + high_W);
    double radius = 0.0;
    Shape its{};
    for (std::size_t i = 0; i < kBlock; ++i) {
      const Eigen::Vector3d offset_W = all.p_W(cells[first + i]) - middle_W;
      for (int axis = 0; axis < 3; ++axis) its.offset_m[axis][i] = static_cast<float>(offset_W[axis]);
      radius = std::max(radius, offset_W.norm());
    }
    x_m.push_back(middle_W.x());
    y_m.push_back(middle_W.y());
    z_m.push_back(middle_W.z());
    radius_m.push_back(static_cast<float>(1.000001 * radius));
    if (shapes.empty() || !(shapes.back() == its)) shapes.push_back(its);
    shape.push_back(static_cast<std::uint32_t>(shapes.size() - 1));
  }
}

std::vector<double> CellBlocks::by_block(std::span<const double> by_cell) const {
  std::vector<double> values(cells.size(), 0.0);
  for (std::size_t i = 0; i < size; ++i) values[i] = by_cell[cells[i]];
  return values;
}

std::vector<double> CellBlocks::by_cell(std::span<const double> by_block) const {
  std::vector<double> values(cells.size(), 0.0);
  for (std::size_t i = 0; i < size; ++i) values[cells[i]] = by_block[i];
  return values;
}

}  // namespace comptonaut
