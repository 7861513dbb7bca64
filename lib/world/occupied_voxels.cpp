// SPDX-License-Identifier: BSD-3-Clause
#include "world/occupied_voxels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace comptonaut {
namespace {

constexpr int kEdge = 8;
constexpr double kBricksMax = 2.5e7;

constexpr double kNowhere_m = 1e9;
constexpr double kNever = 2.0;  // shares of a way end with 1

Eigen::Vector3i vector_of(VoxelKey key) { return {key.x, key.y, key.z}; }

/// From cube to cube (or column to column) along a way [Amanatides and Woo 1987]: which one it is in, and at which
/// share of the way it leaves that across each axis.
template <int kAxes>
struct Walk {
  std::array<int, kAxes> at, step, size;
  std::array<double, kAxes> next, each;

  /// Into the next one across the axis; false: out of all.
  bool go(int axis) {
    at[axis] += step[axis];
    next[axis] += each[axis];
    return at[axis] >= 0 && at[axis] < size[axis];
  }
};

template <int kAxes>
Walk<kAxes> walk_of(const Eigen::Vector3d& a_W, const Eigen::Vector3d& way_W, double begin, double edge_m,
                    const Eigen::Vector3d& first_W, const Eigen::Vector3i& size) {
  Walk<kAxes> walk;
  for (int axis = 0; axis < kAxes; ++axis) {
    const double place = (a_W[axis] + begin * way_W[axis] - first_W[axis]) / edge_m;
    walk.size[axis] = size[axis];
    walk.at[axis] = std::clamp(static_cast<int>(std::floor(place)), 0, size[axis] - 1);
    walk.step[axis] = way_W[axis] > 0.0 ? 1 : -1;
    const double border_m = first_W[axis] + edge_m * (walk.at[axis] + (way_W[axis] > 0.0 ? 1 : 0));
    const bool across = way_W[axis] != 0.0;
    walk.next[axis] = across ? (border_m - a_W[axis]) / way_W[axis] : kNever;
    walk.each[axis] = across ? edge_m / std::abs(way_W[axis]) : 0.0;
  }
  return walk;
}

}  // namespace

OccupiedVoxels::OccupiedVoxels(double voxel_m, VoxelKey first, VoxelKey last)
    : voxel_m_(voxel_m), first_(vector_of(first)), size_(vector_of(last) - first_ + Eigen::Vector3i::Ones()) {
  bricks_ = (size_ + Eigen::Vector3i::Constant(kEdge - 1)) / kEdge;
  const double bricks = bricks_.cast<double>().prod();
  if (!(bricks <= kBricksMax)) {
    throw std::invalid_argument(
        fmt::format("obstacles over {} x {} x {} voxels are too many", size_.x(), size_.y(), size_.z()));
  }
  brick_at_.assign(static_cast<std::size_t>(bricks), kEmpty);
  top_m_.assign(static_cast<std::size_t>(bricks_.x()) * static_cast<std::size_t>(bricks_.y()), -kNowhere_m);
}

std::size_t OccupiedVoxels::index(const Eigen::Vector3i& brick) const {
  return (static_cast<std::size_t>(brick.z()) * static_cast<std::size_t>(bricks_.y()) +
          static_cast<std::size_t>(brick.y())) *
             static_cast<std::size_t>(bricks_.x()) +
         static_cast<std::size_t>(brick.x());
}

void OccupiedVoxels::fill(VoxelKey corner, int size) {
  const Eigen::Vector3i low = (vector_of(corner) - first_).cwiseMax(0);
  const Eigen::Vector3i high =
      (vector_of(corner) - first_ + Eigen::Vector3i::Constant(size - 1)).cwiseMin(size_ - Eigen::Vector3i::Ones());
  if ((low.array() > high.array()).any()) return;
  const Eigen::Vector3i from = low / kEdge, to = high / kEdge;
  for (int z = from.z(); z <= to.z(); ++z) {
    for (int y = from.y(); y <= to.y(); ++y) {
      for (int x = from.x(); x <= to.x(); ++x) {
        fill_brick({x, y, z}, low, high);
        double& top_m = top_m_[index({x, y, 0})];
        top_m = std::max(top_m, voxel_m_ * (first_.z() + high.z() + 1));
      }
    }
  }
}

void OccupiedVoxels::fill_brick(const Eigen::Vector3i& brick, const Eigen::Vector3i& low, const Eigen::Vector3i& high) {
  const Eigen::Vector3i from = (low - kEdge * brick).cwiseMax(0);
  const Eigen::Vector3i to = (high - kEdge * brick).cwiseMin(kEdge - 1);
  std::uint32_t& at = brick_at_[index(brick)];
  if (at == kFull) return;
  if ((to - from).minCoeff() == kEdge - 1) {
    at = kFull;
    return;
  }
  if (at == kEmpty) {
    bits_.push_back({});
    at = static_cast<std::uint32_t>(bits_.size()) + 1;
  }
  for (int z = from.z(); z <= to.z(); ++z) {
    for (int y = from.y(); y <= to.y(); ++y) {
      for (int x = from.x(); x <= to.x(); ++x) bits_[at - 2][z] |= std::uint64_t{1} << (kEdge * y + x);
    }
  }
}

bool OccupiedVoxels::occupied(const Eigen::Vector3i& at) const {
  const std::uint32_t brick = brick_at_[index(at / kEdge)];
  if (brick <= kFull) return brick == kFull;
  return (bits_[brick - 2][at.z() % kEdge] >> (kEdge * (at.y() % kEdge) + at.x() % kEdge) & 1U) != 0;
}

/// Over the columns of bricks; into voxels only where the way lies lower than a column's top.
double OccupiedVoxels::length_m(const Eigen::Vector3d& a_W, const Eigen::Vector3d& b_W, double enough_m) const {
  const Eigen::Vector3d way_W = b_W - a_W;
  const double whole_m = way_W.norm(), column_m = kEdge * voxel_m_;
  double begin = 0.0, end = 1.0;  // of the way, within the bounds of all voxels
  for (int axis = 0; axis < 3; ++axis) {
    const double low = voxel_m_ * first_[axis], high = voxel_m_ * (first_[axis] + size_[axis]);
    if (way_W[axis] == 0.0) {
      if (a_W[axis] < low || a_W[axis] >= high) return 0.0;
      continue;
    }
    const double one = (low - a_W[axis]) / way_W[axis], other = (high - a_W[axis]) / way_W[axis];
    begin = std::max(begin, std::min(one, other));
    end = std::min(end, std::max(one, other));
  }
  if (!(begin < end)) return 0.0;

  Walk<2> walk = walk_of<2>(a_W, way_W, begin, column_m, voxel_m_ * first_.cast<double>(), bricks_);
  const double enough = enough_m / whole_m;
  double sum = 0.0, low_since = kNever;
  for (double here = begin; here < end && sum <= enough;) {
    const int axis = walk.next[0] < walk.next[1] ? 0 : 1;
    const double leaves = std::clamp(walk.next[axis], here, end);
    const double low_m = a_W.z() + way_W.z() * (way_W.z() < 0.0 ? leaves : here);
    const auto column = static_cast<std::size_t>(walk.at[1]) * static_cast<std::size_t>(bricks_.x()) +
                        static_cast<std::size_t>(walk.at[0]);
    if (low_m < top_m_[column]) {
      low_since = std::min(low_since, here);
    } else if (low_since != kNever) {
      sum += inside(a_W, way_W, std::exchange(low_since, kNever), here, enough - sum);
    }
    here = leaves;
    if (!walk.go(axis)) break;
  }
  if (low_since != kNever && sum <= enough) sum += inside(a_W, way_W, low_since, end, enough - sum);
  return sum * whole_m;
}

double OccupiedVoxels::inside(const Eigen::Vector3d& a_W, const Eigen::Vector3d& way_W, double begin, double end,
                              double enough) const {
  Walk<3> walk = walk_of<3>(a_W, way_W, begin, voxel_m_, voxel_m_ * first_.cast<double>(), size_);
  double sum = 0.0;
  for (double here = begin; here < end && sum <= enough;) {
    const auto& [x, y, z] = walk.next;
    const int axis = x < y ? (x < z ? 0 : 2) : (y < z ? 1 : 2);
    const double leaves = std::clamp(walk.next[axis], here, end);
    if (leaves > here && occupied({walk.at[0], walk.at[1], walk.at[2]})) sum += leaves - here;
    here = leaves;
    if (!walk.go(axis)) break;
  }
  return sum;
}

}  // namespace comptonaut
