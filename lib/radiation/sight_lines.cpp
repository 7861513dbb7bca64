// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/sight_lines.h"

#include <algorithm>
#include <cmath>

#include "radiation/joint_data.h"

namespace comptonaut {
namespace {

constexpr double kNothing = 20.0;  // mean free paths
constexpr double kLattice_m = 0.25;
constexpr double kBlockOfAir_m = 1.0;
constexpr std::size_t kBlocksKept = 64;

void add(float weight, const std::vector<float>& values, std::vector<float>& sum) {
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += weight * values[i];
}

}  // namespace

float let_through(const World& world, double attenuation_per_m, const Eigen::Vector3d& a_W,
                  const Eigen::Vector3d& b_W) {
  if (!(attenuation_per_m > 0.0)) return 1.0F;
  const double way_m = world.occupied_m(a_W, b_W, kNothing / attenuation_per_m);
  return way_m > 0.0 ? static_cast<float>(std::exp(-std::min(kNothing, attenuation_per_m * way_m))) : 1.0F;
}

std::vector<float> let_through(const World& world, double attenuation_per_m, const Eigen::Vector3d& eye_W,
                               std::span<const Eigen::Vector3d> places_W) {
  std::vector<float> shares;
  shares.reserve(places_W.size());
  for (const Eigen::Vector3d& p_W : places_W) shares.push_back(let_through(world, attenuation_per_m, p_W, eye_W));
  return shares;
}

SightLines::SightLines(World world)
    : world_(std::move(world)), edge_m_(world_.voxel_m() * std::ceil(kLattice_m / world_.voxel_m() - 1e-9)) {}

SightLines::Shares SightLines::shares(const JointData& data, double attenuation_per_m, const Eigen::Vector3d& p_W) {
  constexpr double kHardly = 1e-9;
  Shares sum;
  sum.viewpoints.assign(data.viewpoints.size(), 0.0F);
  sum.pairs.assign(data.pairs.size(), 0.0F);
  const VoxelKey low = voxel_at(p_W, edge_m_);
  const Eigen::Vector3d part = p_W / edge_m_ - Eigen::Vector3d(low.x, low.y, low.z);
  for (int corner = 0; corner < 8; ++corner) {
    const int x = corner & 1, y = corner >> 1 & 1, z = corner >> 2;
    const double weight = (x == 1 ? part.x() : 1.0 - part.x()) * (y == 1 ? part.y() : 1.0 - part.y()) *
                          (z == 1 ? part.z() : 1.0 - part.z());
    if (weight < kHardly) continue;
    const Shares& there = at_corner(data, attenuation_per_m, {low.x + x, low.y + y, low.z + z});
    add(static_cast<float>(weight), there.viewpoints, sum.viewpoints);
    add(static_cast<float>(weight), there.pairs, sum.pairs);
  }
  if (kept_ > kKept) forget_old();
  return sum;
}

const SightLines::Shares& SightLines::at_corner(const JointData& data, double attenuation_per_m,
                                                const VoxelKey& corner) {
  Column& column = columns_[{attenuation_per_m, corner}];
  column.asked = ++asked_;
  const Eigen::Vector3d p_W = edge_m_ * Eigen::Vector3d(corner.x, corner.y, corner.z);
  const Viewpoints& v = data.viewpoints;
  auto& [viewpoints, pairs] = column.shares;
  kept_ += v.size() - viewpoints.size() + data.pairs.size() - pairs.size();
  for (std::size_t i = viewpoints.size(); i < v.size(); ++i) {
    viewpoints.push_back(let_through(world_, attenuation_per_m, p_W, {v.x_m[i], v.y_m[i], v.z_m[i]}));
  }
  for (std::size_t i = pairs.size(); i < data.pairs.size(); ++i) {
    pairs.push_back(let_through(world_, attenuation_per_m, p_W, data.pairs[i].p_WS));
  }
  return column.shares;
}

/// The half that was not asked for longest.
void SightLines::forget_old() {
  std::vector<std::uint64_t> asked;
  for (const auto& [corner, column] : columns_) asked.push_back(column.asked);
  const auto middle = asked.begin() + static_cast<std::ptrdiff_t>(asked.size() / 2);
  std::ranges::nth_element(asked, middle);
  std::erase_if(columns_, [&](const auto& entry) { return entry.second.asked < *middle; });
  kept_ = 0;
  for (const auto& [corner, column] : columns_) {
    kept_ += column.shares.viewpoints.size() + column.shares.pairs.size();
  }
}

std::span<const float> BlockSight::shares(const Eigen::Vector3d& eye_W, std::span<const Eigen::Vector3d> places_W) {
  const VoxelKey key = voxel_at(eye_W, kBlockOfAir_m);
  const auto known = blocks_.find(key);
  if (known != blocks_.end()) return known->second;
  if (blocks_.size() >= kBlocksKept) blocks_.clear();
  const Eigen::Vector3d middle_W = kBlockOfAir_m * Eigen::Vector3d(key.x + 0.5, key.y + 0.5, key.z + 0.5);
  return blocks_.emplace(key, let_through(world_, attenuation_per_m_, middle_W, places_W)).first->second;
}

}  // namespace comptonaut
