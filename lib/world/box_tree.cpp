// SPDX-License-Identifier: BSD-3-Clause
#include "world/box_tree.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>

#include "core/simd.h"

namespace comptonaut {
namespace {

constexpr std::size_t kLanes = BoxTree::kLanes;

/// Puts boxes together that follow on each other along an axis and are alike across it.
void merge_along(std::size_t axis, std::vector<VoxelBox>& boxes) {
  const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  std::ranges::sort(boxes, {}, [=](const VoxelBox& box) {
    return std::tuple(box.low[u], box.high[u], box.low[v], box.high[v], box.low[axis]);
  });
  std::size_t n = 0;
  for (const VoxelBox& box : boxes) {
    VoxelBox grown = n > 0 ? boxes[n - 1] : VoxelBox();
    grown.high[axis] = box.high[axis];
    VoxelBox whole = box;
    whole.low[axis] = grown.low[axis];
    if (n > 0 && grown == whole && boxes[n - 1].high[axis] == box.low[axis]) {
      boxes[n - 1] = grown;
    } else {
      boxes[n++] = box;
    }
  }
  boxes.resize(n);
}

/// In an order of which each run of 8, of 64, of 512, ... lies close together.
void arrange(std::span<VoxelBox> boxes) {
  if (boxes.size() <= kLanes) return;
  std::size_t run = kLanes;
  while (run * kLanes < boxes.size()) run *= kLanes;
  const std::size_t half = (boxes.size() + run - 1) / run / 2 * run;
  std::array<int, 3> extent{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto [least, most] = std::ranges::minmax(boxes, {}, [=](const VoxelBox& box) { return box.low[axis]; });
    extent[axis] = most.low[axis] - least.low[axis];
  }
  const auto axis = static_cast<std::size_t>(std::ranges::max_element(extent) - extent.begin());
  std::ranges::nth_element(boxes, boxes.begin() + static_cast<std::ptrdiff_t>(half), {},
                           [=](const VoxelBox& box) { return std::tuple(box.low[axis] + box.high[axis], box.low); });
  arrange(boxes.first(half));
  arrange(boxes.subspan(half));
}

/// A way from a on, and one over it along each axis.
struct Way {
  std::array<double, 3> from_m, inverse_per_m;
};

/// Shares of the way in each of eight boxes; nothing, or less, where it passes by.
[[gnu::always_inline]] inline void shares_in(const BoxTree::Eight& boxes, const Way& way, double* __restrict__ shares) {
  std::array<double, kLanes> enters{}, leaves;
  leaves.fill(1.0);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double* low_m = boxes.low_m[axis].data();
    const double* high_m = boxes.high_m[axis].data();
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const double one = (low_m[lane] - way.from_m[axis]) * way.inverse_per_m[axis];
      const double other = (high_m[lane] - way.from_m[axis]) * way.inverse_per_m[axis];
      const double first = one < other ? one : other, last = one < other ? other : one;
      enters[lane] = enters[lane] > first ? enters[lane] : first;
      leaves[lane] = leaves[lane] < last ? leaves[lane] : last;
    }
  }
  for (std::size_t lane = 0; lane < kLanes; ++lane) shares[lane] = leaves[lane] - enters[lane];
}

COMPTONAUT_SIMD_CLONES
double share_inside(const std::vector<std::vector<BoxTree::Eight>>& levels, std::size_t level, std::size_t at,
                    const Way& way, double enough) {
  double shares[kLanes];
  shares_in(levels[level][at], way, shares);
  if (level == 0) {
    for (double& share : shares) share = share > 0.0 ? share : 0.0;
    return ((shares[0] + shares[4]) + (shares[2] + shares[6])) + ((shares[1] + shares[5]) + (shares[3] + shares[7]));
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < kLanes && sum <= enough; ++i) {
    if (shares[i] > 0.0) sum += share_inside(levels, level - 1, at * kLanes + i, way, enough - sum);
  }
  return sum;
}

}  // namespace

std::vector<VoxelBox> merged(std::vector<VoxelBox> boxes) {
  for (std::size_t before = boxes.size() + 1; boxes.size() < before;) {
    before = boxes.size();
    for (const std::size_t axis : {0, 1, 2}) merge_along(axis, boxes);  // layers of ground before columns
  }
  return boxes;
}

BoxTree::BoxTree(double voxel_m, std::vector<VoxelBox> boxes) {
  arrange(boxes);
  std::vector<std::array<Eigen::Vector3d, 2>> corners_m;
  for (const auto& [low, high] : boxes) {
    corners_m.push_back(
        {voxel_m * Eigen::Vector3d(low[0], low[1], low[2]), voxel_m * Eigen::Vector3d(high[0], high[1], high[2])});
  }
  add_level(corners_m);
}

/// And those above it.
void BoxTree::add_level(const std::vector<std::array<Eigen::Vector3d, 2>>& corners_m) {
  constexpr double kNowhere_m = 1e9;
  std::vector<Eight>& level = levels_.emplace_back();
  std::vector<std::array<Eigen::Vector3d, 2>> bounds_m;
  for (std::size_t j = 0; j < corners_m.size(); ++j) {
    const auto& [low_m, high_m] = corners_m[j];
    const std::size_t lane = j % kLanes;
    if (lane == 0) {
      bounds_m.push_back(corners_m[j]);
      for (auto* corner : {&level.emplace_back().low_m, &level.back().high_m}) {
        for (auto& lanes : *corner) lanes.fill(kNowhere_m);
      }
    }
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      level.back().low_m[axis][lane] = low_m[axis];
      level.back().high_m[axis][lane] = high_m[axis];
    }
    auto& [low, high] = bounds_m.back();
    low = low.cwiseMin(low_m);
    high = high.cwiseMax(high_m);
  }
  if (bounds_m.size() > 1) add_level(bounds_m);
}

double BoxTree::length_m(const Eigen::Vector3d& a_W, const Eigen::Vector3d& b_W, double enough_m) const {
  constexpr double kAlong = 1e290;  // a way that does not move along an axis is inside from the lower face on
  const Eigen::Vector3d way_W = b_W - a_W;
  const double whole_m = way_W.norm();
  if (!(whole_m > 0.0)) return 0.0;
  Way way{};
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    way.from_m[axis] = a_W[axis];
    way.inverse_per_m[axis] = std::abs(way_W[axis]) > 1.0 / kAlong ? 1.0 / way_W[axis] : kAlong;
  }
  return whole_m * share_inside(levels_, levels_.size() - 1, 0, way, enough_m / whole_m);
}

}  // namespace comptonaut
