// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>

#include "core/cells.h"

namespace comptonaut {

/// An axis-aligned box in frame W, m.
struct Box {
  Eigen::Vector3d min_W = Eigen::Vector3d::Zero();
  Eigen::Vector3d max_W = Eigen::Vector3d::Zero();

  [[nodiscard]] bool touches(const Box& other) const {
    return (min_W.array() <= other.max_W.array()).all() && (max_W.array() >= other.min_W.array()).all();
  }
};

enum class Occupancy { kFree, kOccupied, kUnknown };

/// What nobody has seen: free to fly through, or closed like an obstacle.
enum class UnknownSpace { kClosed, kFree };

/// What is known of one voxel now.
struct VoxelChange {
  VoxelKey voxel;
  Occupancy occupancy = Occupancy::kUnknown;

  bool operator==(const VoxelChange&) const = default;
};

/// Terrain and obstacles: flat ground, an OctoMap [Hornung et al. 2013], or flat ground with single voxels that are
/// otherwise. Immutable, so copies share the map.
class World {
 public:
  /// Occupied up to ground_z_m, free above. Voxels that are changed later (`with`) have the edge voxel_m. Throws
  /// std::invalid_argument unless the height is finite and the edge 0.01 to 10 m.
  [[nodiscard]] static World flat(double ground_z_m = 0.0, double voxel_m = 0.5);

  /// An OctoMap file, .bt or .ot, in frame W. A voxel of an .ot counts as occupied from a probability of 0.5.
  /// Throws std::runtime_error that names the file and what is wrong with it.
  [[nodiscard]] static World load(const std::filesystem::path& file, UnknownSpace unknown = UnknownSpace::kClosed);

  /// What `at` says of each voxel's centre within `extent`; all else is unknown. Throws std::invalid_argument as
  /// build_octree does.
  [[nodiscard]] static World of_voxels(const Box& extent, double voxel_m,
                                       const std::function<Occupancy(const Eigen::Vector3d& p_W)>& at);

  /// Ground that is occupied up to ground_z_m with boxes on it; a voxel is occupied where its centre is. What lies
  /// outside `extent` is unknown. Throws std::invalid_argument as build_octree does.
  [[nodiscard]] static World of_boxes(std::span<const Box> boxes, const Box& extent, double voxel_m,
                                      double ground_z_m = 0.0);

  /// This world with some of its smallest voxels as `changes` say, of one that stands there twice as the last one does.
  /// On flat ground an unknown voxel is again as the ground has it. Costs a copy of the map. Throws
  /// std::invalid_argument for voxels further than 32,768 from the origin.
  [[nodiscard]] World with(std::span<const VoxelChange> changes) const;

  /// Writes an OctoMap file, .bt. Throws std::logic_error for flat ground, std::runtime_error with the file's name
  /// where it cannot be written.
  void save(const std::filesystem::path& file) const;

  /// Flat ground without a voxel that is otherwise.
  [[nodiscard]] bool is_flat() const;
  /// Edge of its smallest voxels, m.
  [[nodiscard]] double voxel_m() const;

  [[nodiscard]] Occupancy at(const Eigen::Vector3d& p_W) const;

  /// Space that must not be entered: occupied or, where unknown space is closed, unknown.
  [[nodiscard]] bool closed(const Eigen::Vector3d& p_W) const;
  /// Whether any of the region, its border included, is closed.
  [[nodiscard]] bool closed(const Box& region) const;
  /// Calls `hit` with each closed box that touches the region (as large as the map holds them, not cut to the region)
  /// until it returns true; returns whether it did.
  [[nodiscard]] bool any_closed(const Box& region, const std::function<bool(const Box&)>& hit) const;

  /// Length of the straight way from a to b through occupied space, m: what a photon has to pass. Once it exceeds
  /// `enough_m`, at least that. Along a surface counts as outside or inside.
  [[nodiscard]] double occupied_m(const Eigen::Vector3d& a_W, const Eigen::Vector3d& b_W,
                                  double enough_m = std::numeric_limits<double>::infinity()) const;

  /// How far it is from p_W along a direction to occupied space; nullopt: further than max_m. On flat ground with
  /// changed voxels a hole in the ground counts as ground.
  [[nodiscard]] std::optional<double> range_m(const Eigen::Vector3d& p_W, const Eigen::Vector3d& direction_W,
                                              double max_m) const;

  /// Height of the terrain at (x, y): top of the highest occupied voxel that has free space above it (unknown space
  /// counts as free where it is not closed). nullopt: the column has none.
  [[nodiscard]] std::optional<double> ground_height_m(double x_m, double y_m) const;

  /// Where sources may lie: for each column of edge cell_m whose centre lies in the area and has ground, one cell at
  /// the ground's height there, roofs being ground; and above it the walls beside (wall_cells), so the lowest cell of a
  /// column is its ground. Flat ground gives flat_cells(). Throws std::invalid_argument as flat_cells does.
  [[nodiscard]] Cells surface_cells(const Area& area, double cell_m) const;

  /// The same for the same terrain, on every machine, however its file stores it.
  [[nodiscard]] std::uint64_t hash() const;

 private:
  struct Impl;
  [[nodiscard]] static World of_tree(std::unique_ptr<Impl> impl);
  explicit World(std::shared_ptr<const Impl> impl);
  [[nodiscard]] Occupancy voxel_as_flat(VoxelKey voxel) const;
  std::shared_ptr<const Impl> impl_;
};

}  // namespace comptonaut
