// SPDX-License-Identifier: BSD-3-Clause
#include "world/occupied_voxels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace comptonaut {
namespace {

constexpr int kEdge = 8;
constexpr double kBricksMax = 2.5e7;

Eigen::Vector3i vector_of(VoxelKey key) { return {key.x, key.y, key.z}; }

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
      for (int x = from.x(); x <= to.x(); ++x) fill_brick({x, y, z}, low, high);
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

/// From voxel to voxel along the way [Amanatides and Woo 1987].
double OccupiedVoxels::length_m(const Eigen::Vector3d& a_W, const Eigen::Vector3d& b_W, double enough_m) const {
  const Eigen::Vector3d way_W = b_W - a_W;
  const double whole_m = way_W.norm();
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

  Eigen::Vector3i at, step;
  Eigen::Vector3d next, each;  // where the way leaves the voxel across each axis, how long it stays in each
  for (int axis = 0; axis < 3; ++axis) {
    const double place = (a_W[axis] + begin * way_W[axis]) / voxel_m_ - first_[axis];
    at[axis] = std::clamp(static_cast<int>(std::floor(place)), 0, size_[axis] - 1);
    step[axis] = way_W[axis] > 0.0 ? 1 : -1;
    const int border = first_[axis] + at[axis] + (way_W[axis] > 0.0 ? 1 : 0);
    const bool across = way_W[axis] != 0.0;
    next[axis] = across ? (voxel_m_ * border - a_W[axis]) / way_W[axis] : 2.0;
    each[axis] = across ? voxel_m_ / std::abs(way_W[axis]) : 0.0;
  }
  double inside = 0.0;
  for (double here = begin; here < end && inside * whole_m <= enough_m;) {
    const int axis = next.x() < next.y() ? (next.x() < next.z() ? 0 : 2) : (next.y() < next.z() ? 1 : 2);
    const double leaves = std::clamp(next[axis], here, end);
    if (leaves > here && occupied(at)) inside += leaves - here;
    here = leaves;
    at[axis] += step[axis];
    next[axis] += each[axis];
    if (at[axis] < 0 || at[axis] >= size_[axis]) break;
  }
  return inside * whole_m;
}

}  // namespace comptonaut
