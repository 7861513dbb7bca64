// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "core/cells.h"
#include "world/world.h"

namespace comptonaut {

struct JointData;

/// exp(-mu l): the share of photons that come from a to b through l metres of occupied space. Below 2e-9 counts as it.
[[nodiscard]] float let_through(const World& world, double attenuation_per_m, const Eigen::Vector3d& a_W,
                                const Eigen::Vector3d& b_W);
/// The same from one eye to each place.
[[nodiscard]] std::vector<float> let_through(const World& world, double attenuation_per_m, const Eigen::Vector3d& eye_W,
                                             std::span<const Eigen::Vector3d> places_W);

/// What obstacles let through from sources, wherever these are moved, to all viewpoints and pairs of one data set,
/// which may only grow. Computed at the corners of a lattice where somebody asks, as the shadow's edge cannot be told
/// more exactly than poses are, and kept: a fit comes back to the same few corners again and again. What is asked last
/// is kept longest, as far as kKept numbers; no answer depends on what is kept.
class SightLines {
 public:
  explicit SightLines(World world);

  [[nodiscard]] const World& world() const { return world_; }

  /// Per viewpoint and per pair, in the data's order.
  struct Shares {
    std::vector<float> viewpoints, pairs;
  };
  /// Linear between the eight corners about p_W, so that a source's place has a slope.
  [[nodiscard]] Shares shares(const JointData& data, double attenuation_per_m, const Eigen::Vector3d& p_W);

 private:
  static constexpr std::size_t kKept = 16'000'000;

  struct Column {
    Shares shares;
    std::uint64_t asked = 0;
  };
  [[nodiscard]] const Shares& at_corner(const JointData& data, double attenuation_per_m, const VoxelKey& corner);
  void forget_old();

  World world_;
  double edge_m_;  ///< of the lattice: of whole voxels
  std::map<std::pair<double, VoxelKey>, Column> columns_;
  std::size_t kept_ = 0;  ///< numbers in all columns
  std::uint64_t asked_ = 0;
};

/// What obstacles let through to many places, as it is seen from the middle of the block of air that an eye is in;
/// those of the last blocks are kept.
class BlockSight {
 public:
  BlockSight(World world, double attenuation_per_m) : world_(std::move(world)), attenuation_per_m_(attenuation_per_m) {}

  [[nodiscard]] std::span<const float> shares(const Eigen::Vector3d& eye_W, std::span<const Eigen::Vector3d> places_W);

 private:
  World world_;
  double attenuation_per_m_;
  std::map<VoxelKey, std::vector<float>> blocks_;
};

}  // namespace comptonaut
