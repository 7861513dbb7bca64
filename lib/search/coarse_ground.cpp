// SPDX-License-Identifier: BSD-3-Clause
#include "search/coarse_ground.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

namespace comptonaut {
namespace {

VoxelKey square_of(const Eigen::Vector3d& p_W, double edge_m) { return voxel_at({p_W.x(), p_W.y(), 0.0}, edge_m); }

/// The lowest cell of each column.
std::vector<Eigen::Vector3d> grounds(const Cells& cells) {
  std::map<std::pair<std::int32_t, std::int32_t>, Eigen::Vector3d> lowest;
  for (std::size_t j = 0; j < cells.size(); ++j) {
    const auto [low, fresh] = lowest.try_emplace({cells.key(j).y, cells.key(j).x}, cells.p_W(j));
    if (!fresh && cells.p_W(j).z() < low->second.z()) low->second = cells.p_W(j);
  }
  std::vector<Eigen::Vector3d> result;
  for (const auto& [column, p_W] : lowest) result.push_back(p_W);
  return result;
}

}  // namespace

CoarseGround::CoarseGround(const Cells& cells, double edge_m, std::size_t squares_max) {
  struct Sum {
    Eigen::Vector3d p_W = Eigen::Vector3d::Zero();
    double n = 0.0, z_max_m = -std::numeric_limits<double>::infinity();
    Eigen::Vector3d low_W = Eigen::Vector3d::Zero();
    double low_n = 0.0, low_m = std::numeric_limits<double>::infinity();

    void add_low(const Eigen::Vector3d& place_W) {
      constexpr double kLevel_m = 1.0;
      if (place_W.z() < low_m - kLevel_m) low_W.setZero(), low_n = 0.0;
      low_m = std::min(low_m, place_W.z());
      if (place_W.z() <= low_m + kLevel_m) low_W += place_W, low_n += 1.0;
    }
  };
  if (cells.size() == 0) throw std::invalid_argument("a search needs cells, there are none");
  const std::vector<Eigen::Vector3d> columns_W = grounds(cells);
  const double ground_m2 = static_cast<double>(columns_W.size()) * cells.cell_m() * cells.cell_m();
  edge_m_ = std::max({edge_m, cells.cell_m(), std::sqrt(ground_m2 / static_cast<double>(squares_max))});
  area_ = bounding_area(cells);
  std::map<VoxelKey, Sum> sums;
  for (const Eigen::Vector3d& p_W : columns_W) {
    Sum& sum = sums[square_of(p_W, edge_m_)];
    sum.p_W += p_W;
    sum.n += 1.0;
    sum.z_max_m = std::max(sum.z_max_m, p_W.z());
    sum.add_low(p_W);
  }
  std::vector<VoxelKey> keys;
  for (const auto& [key, sum] : sums) {
    keys.push_back(key);
    p_W_.emplace_back(sum.p_W.x() / sum.n, sum.p_W.y() / sum.n, sum.z_max_m);
    low_W_.emplace_back(sum.low_W.x() / sum.low_n, sum.low_W.y() / sum.low_n, sum.low_m);
  }
  number(keys);
}

void CoarseGround::number(const std::vector<VoxelKey>& keys) {
  std::int32_t x_last = keys[0].x, y_last = keys[0].y;
  x_first_ = x_last, y_first_ = y_last;
  for (const VoxelKey& key : keys) {
    x_first_ = std::min(x_first_, key.x), x_last = std::max(x_last, key.x);
    y_first_ = std::min(y_first_, key.y), y_last = std::max(y_last, key.y);
  }
  columns_ = x_last - x_first_ + 1, rows_ = y_last - y_first_ + 1;
  for (std::int32_t y = y_first_; y <= y_last; ++y) {
    for (std::int32_t x = x_first_; x <= x_last; ++x) {
      const auto away2 = [x, y](const VoxelKey& key) {
        const double dx = key.x - x, dy = key.y - y;
        return dx * dx + dy * dy;
      };
      const auto nearest = std::ranges::min_element(keys, {}, away2);
      square_at_.push_back(static_cast<std::uint32_t>(nearest - keys.begin()));
    }
  }
}

std::size_t CoarseGround::at(const Eigen::Vector3d& p_W) const {
  const double x = std::clamp(p_W.x(), area_.x_min_m, area_.x_max_m);
  const double y = std::clamp(p_W.y(), area_.y_min_m, area_.y_max_m);
  const VoxelKey key = square_of({x, y, 0.0}, edge_m_);
  const std::int32_t column = std::clamp(key.x - x_first_, 0, columns_ - 1);
  const std::int32_t row = std::clamp(key.y - y_first_, 0, rows_ - 1);
  return square_at_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                    static_cast<std::size_t>(column)];
}

}  // namespace comptonaut
