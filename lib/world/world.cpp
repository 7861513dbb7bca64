// SPDX-License-Identifier: BSD-3-Clause
#include "world/world.h"

#include <fmt/format.h>
#include <octomap/OcTree.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/hash.h"
#include "world/box_tree.h"
#include "world/build_octree.h"
#include "world/octomap_file.h"
#include "world/octree_rays.h"
#include "world/wall_cells.h"

namespace comptonaut {
namespace {

/// A cube of the octree and what is known of it: `node` null is unknown space.
struct Cube {
  const octomap::OcTreeNode* node;
  Box box;

  [[nodiscard]] bool leaf(const octomap::OcTree& tree) const { return node == nullptr || !tree.nodeHasChildren(node); }
  [[nodiscard]] Occupancy occupancy(const octomap::OcTree& tree) const {
    if (node == nullptr) return Occupancy::kUnknown;
    return tree.isNodeOccupied(node) ? Occupancy::kOccupied : Occupancy::kFree;
  }
  // Bits 0, 1, 2 of i: the upper half along x, y, z.
  [[nodiscard]] Cube child(const octomap::OcTree& tree, unsigned i) const {
    const bool exists = tree.nodeChildExists(node, i);
    Cube result{.node = exists ? tree.getNodeChild(node, i) : nullptr, .box = box};
    const Eigen::Vector3d middle = 0.5 * (box.min_W + box.max_W);
    for (int axis = 0; axis < 3; ++axis) {
      ((i >> axis & 1U) != 0 ? result.box.min_W : result.box.max_W)[axis] = middle[axis];
    }
    return result;
  }
};

void hash_cube(const octomap::OcTree& tree, const Cube& cube, Fnv1a& hash) {
  if (cube.leaf(tree)) return hash.add(static_cast<std::uint8_t>(cube.occupancy(tree)));
  hash.add(std::uint8_t{0xFF});
  for (unsigned i = 0; i < 8; ++i) hash_cube(tree, cube.child(tree, i), hash);
}

}  // namespace

struct World::Impl {
  std::optional<double> ground_z_m;  ///< of flat ground: what the tree does not hold is as it says
  double voxel_m = 0.5;
  std::unique_ptr<octomap::OcTree> tree;  ///< null: flat ground and nothing else
  std::unique_ptr<BoxTree> occupied;      ///< of the tree; null: none are
  std::unique_ptr<BoxTree> holes;         ///< free ones of the tree on flat ground; null: none are
  UnknownSpace unknown = UnknownSpace::kClosed;
  std::uint64_t hash = 0;

  [[nodiscard]] Cube root() const {
    const Eigen::Vector3d half = Eigen::Vector3d::Constant(std::ldexp(tree->getResolution(), 15));
    return {.node = tree->getRoot(), .box = {.min_W = -half, .max_W = half}};
  }
  [[nodiscard]] bool closed(Occupancy occupancy) const {
    return occupancy == Occupancy::kOccupied || (occupancy == Occupancy::kUnknown && unknown == UnknownSpace::kClosed);
  }
  [[nodiscard]] Occupancy flat_at(double z_m) const {
    return z_m <= *ground_z_m ? Occupancy::kOccupied : Occupancy::kFree;
  }
  /// Of a leaf, what is closed of it; nullopt: nothing.
  [[nodiscard]] std::optional<Box> closed_part(const Cube& leaf) const {
    Box part = leaf.box;
    if (leaf.node != nullptr || !ground_z_m) return closed(leaf.occupancy(*tree)) ? std::optional(part) : std::nullopt;
    part.max_W.z() = std::min(part.max_W.z(), *ground_z_m);
    return part.min_W.z() < part.max_W.z() ? std::optional(part) : std::nullopt;
  }
  bool any_closed(const Cube& cube, const Box& region, const std::function<bool(const Box&)>& hit) const {
    if (!cube.box.touches(region)) return false;
    if (cube.leaf(*tree)) {
      const auto part = closed_part(cube);
      return part && part->touches(region) && hit(*part);
    }
    for (unsigned i = 0; i < 8; ++i) {
      if (any_closed(cube.child(*tree, i), region, hit)) return true;
    }
    return false;
  }
  /// Goes down the column at (x, y); `open_above` is whether what lies on top of the cube is free.
  std::optional<double> ground_in(const Cube& cube, double x_m, double y_m, bool& open_above) const {
    if (cube.leaf(*tree)) {
      const auto part = closed_part(cube);
      const bool open_top = !part || part->max_W.z() < cube.box.max_W.z();
      const bool solid = part && (cube.node == nullptr ? ground_z_m.has_value() : tree->isNodeOccupied(cube.node));
      const bool ground = solid && (open_above || open_top);
      open_above = !part;
      return ground ? std::optional(part->max_W.z()) : std::nullopt;
    }
    const Eigen::Vector3d middle = 0.5 * (cube.box.min_W + cube.box.max_W);
    const unsigned column = (x_m >= middle.x() ? 1U : 0U) | (y_m >= middle.y() ? 2U : 0U);
    const auto upper = ground_in(cube.child(*tree, column | 4U), x_m, y_m, open_above);
    return upper ? upper : ground_in(cube.child(*tree, column), x_m, y_m, open_above);
  }
  /// On flat ground: the part of the way below it without holes, and what is occupied on the part above it.
  [[nodiscard]] double occupied_on_flat_m(const Eigen::Vector3d& a_W, const Eigen::Vector3d& b_W) const {
    const double a_m = *ground_z_m - a_W.z(), b_m = *ground_z_m - b_W.z();  // below the ground
    const bool a_below = a_m > 0.0, b_below = b_m > 0.0;
    const Eigen::Vector3d through_W = a_below == b_below ? b_W : Eigen::Vector3d(a_W + a_m / (a_m - b_m) * (b_W - a_W));
    const auto way_m = [this](bool below, const Eigen::Vector3d& from_W, const Eigen::Vector3d& to_W) {
      if (!below) return occupied ? occupied->length_m(from_W, to_W) : 0.0;
      return (to_W - from_W).norm() - (holes ? holes->length_m(from_W, to_W) : 0.0);
    };
    return way_m(a_below, a_W, through_W) + (a_below == b_below ? 0.0 : way_m(b_below, through_W, b_W));
  }
};

World::World(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}

World World::flat(double ground_z_m, double voxel_m) {
  if (!std::isfinite(ground_z_m)) throw std::invalid_argument(fmt::format("height of the ground: {}", ground_z_m));
  if (!(voxel_m >= 0.01 && voxel_m <= 10.0)) throw std::invalid_argument(fmt::format("voxels of {} m", voxel_m));
  auto impl = std::make_shared<Impl>();
  impl->ground_z_m = ground_z_m;
  impl->voxel_m = voxel_m;
  Fnv1a hash;
  hash.add(ground_z_m);
  impl->hash = hash.value();
  return World(std::move(impl));
}

World World::load(const std::filesystem::path& file, UnknownSpace unknown) {
  auto impl = std::make_unique<Impl>();
  impl->tree = read_octomap(file);
  impl->unknown = unknown;
  return of_tree(std::move(impl));
}

World World::of_boxes(std::span<const Box> boxes, const Box& extent, double voxel_m, double ground_z_m) {
  return of_voxels(extent, voxel_m, [&](const Eigen::Vector3d& p_W) {
    const auto holds = [&](const Box& box) { return box.touches({.min_W = p_W, .max_W = p_W}); };
    const bool full = p_W.z() < ground_z_m || std::ranges::any_of(boxes, holds);
    return full ? Occupancy::kOccupied : Occupancy::kFree;
  });
}

World World::of_voxels(const Box& extent, double voxel_m,
                       const std::function<Occupancy(const Eigen::Vector3d& p_W)>& at) {
  auto impl = std::make_unique<Impl>();
  impl->tree = build_octree(extent, voxel_m, at);
  return of_tree(std::move(impl));
}

World World::of_tree(std::unique_ptr<Impl> impl) {
  impl->voxel_m = impl->tree->getResolution();
  impl->occupied = boxes_for_rays(*impl->tree, true);
  if (impl->ground_z_m) impl->holes = boxes_for_rays(*impl->tree, false);
  Fnv1a hash;
  if (impl->ground_z_m) hash.add(*impl->ground_z_m);
  if (impl->unknown == UnknownSpace::kFree) hash.add(std::string_view("unknown space is free"));
  hash.add(impl->voxel_m);
  hash_cube(*impl->tree, impl->root(), hash);
  impl->hash = hash.value();
  return World(std::move(impl));
}

World World::with(std::span<const VoxelChange> changes) const {
  auto impl = std::make_unique<Impl>();
  impl->ground_z_m = impl_->ground_z_m;
  impl->unknown = impl_->unknown;
  impl->tree =
      impl_->tree ? std::make_unique<octomap::OcTree>(*impl_->tree) : std::make_unique<octomap::OcTree>(impl_->voxel_m);
  for (const VoxelChange& change : changes) {
    const bool as_the_ground = impl_->ground_z_m && voxel_as_flat(change.voxel) == change.occupancy;
    set_voxel(*impl->tree, change.voxel, as_the_ground ? Occupancy::kUnknown : change.occupancy);
  }
  if (impl_->ground_z_m && impl->tree->getRoot() == nullptr) return flat(*impl_->ground_z_m, impl_->voxel_m);
  impl->tree->updateInnerOccupancy();
  impl->tree->prune();
  return of_tree(std::move(impl));
}

/// What flat ground makes of a whole voxel; unknown where its surface goes through.
Occupancy World::voxel_as_flat(VoxelKey voxel) const {
  const double low_m = impl_->voxel_m * voxel.z, high_m = impl_->voxel_m * (voxel.z + 1);
  if (high_m <= *impl_->ground_z_m) return Occupancy::kOccupied;
  return low_m >= *impl_->ground_z_m ? Occupancy::kFree : Occupancy::kUnknown;
}

void World::save(const std::filesystem::path& file) const {
  if (impl_->ground_z_m) throw std::logic_error("flat ground has no OctoMap");
  if (!impl_->tree->writeBinaryConst(file.string())) {
    throw std::runtime_error(fmt::format("{}: cannot write the OctoMap file", file.string()));
  }
}

bool World::is_flat() const { return impl_->tree == nullptr; }

double World::voxel_m() const { return impl_->voxel_m; }

double World::occupied_m(const Eigen::Vector3d& a_W, const Eigen::Vector3d& b_W, double enough_m) const {
  if (impl_->ground_z_m) return impl_->occupied_on_flat_m(a_W, b_W);
  return impl_->occupied ? impl_->occupied->length_m(a_W, b_W, enough_m) : 0.0;
}

std::optional<double> World::range_m(const Eigen::Vector3d& p_W, const Eigen::Vector3d& direction_W,
                                     double max_m) const {
  double nearest_m = std::numeric_limits<double>::infinity();
  if (impl_->ground_z_m) {
    const double down = -direction_W.normalized().z(), above_m = p_W.z() - *impl_->ground_z_m;
    if (above_m <= 0.0)
      nearest_m = 0.0;
    else if (down > 0.0)
      nearest_m = above_m / down;
  }
  if (impl_->tree)
    nearest_m = std::min(nearest_m, comptonaut::range_m(*impl_->tree, p_W, direction_W, max_m).value_or(nearest_m));
  return nearest_m <= max_m ? std::optional(nearest_m) : std::nullopt;
}

Occupancy World::at(const Eigen::Vector3d& p_W) const {
  if (!impl_->tree) return impl_->flat_at(p_W.z());
  const Box all = impl_->root().box;
  const bool inside = (p_W.array() >= all.min_W.array()).all() && (p_W.array() < all.max_W.array()).all();
  const auto* node = inside ? impl_->tree->search(p_W.x(), p_W.y(), p_W.z()) : nullptr;
  if (node == nullptr && impl_->ground_z_m) return impl_->flat_at(p_W.z());
  return Cube{.node = node, .box = {}}.occupancy(*impl_->tree);
}

bool World::closed(const Eigen::Vector3d& p_W) const { return impl_->closed(at(p_W)); }

bool World::closed(const Box& region) const {
  return any_closed(region, [](const Box&) { return true; });
}

bool World::any_closed(const Box& region, const std::function<bool(const Box&)>& hit) const {
  constexpr double kFar_m = 1e6;
  if (impl_->tree) return impl_->any_closed(impl_->root(), region, hit);
  const Box ground{.min_W = {-kFar_m, -kFar_m, -kFar_m}, .max_W = {kFar_m, kFar_m, *impl_->ground_z_m}};
  return ground.touches(region) && hit(ground);
}

std::optional<double> World::ground_height_m(double x_m, double y_m) const {
  if (!impl_->tree) return impl_->ground_z_m;
  const Cube root = impl_->root();
  const bool inside =
      x_m >= root.box.min_W.x() && x_m < root.box.max_W.x() && y_m >= root.box.min_W.y() && y_m < root.box.max_W.y();
  bool open_above = impl_->ground_z_m || !impl_->closed(Occupancy::kUnknown);
  return inside ? impl_->ground_in(root, x_m, y_m, open_above) : impl_->ground_z_m;
}

Cells World::surface_cells(const Area& area, double cell_m) const {
  const Cells columns = flat_cells(area, cell_m, impl_->ground_z_m.value_or(0.0));
  if (!impl_->tree) return columns;
  std::vector<Cells::Cell> cells;
  for (std::size_t j = 0; j < columns.size(); ++j) {
    const Eigen::Vector3d& p_W = columns.p_W(j);
    const auto height_m = ground_height_m(p_W.x(), p_W.y());
    if (!height_m) continue;
    // The ground is the top of its voxel, so a height on a voxel border belongs to the voxel below.
    const auto z = static_cast<std::int32_t>(std::ceil(*height_m / cell_m)) - 1;
    cells.push_back({.key = {columns.key(j).x, columns.key(j).y, z}, .p_W = {p_W.x(), p_W.y(), *height_m}});
  }
  const std::vector<Cells::Cell> walls = wall_cells(*this, Cells(cell_m, cells));
  cells.insert(cells.end(), walls.begin(), walls.end());
  return Cells(cell_m, std::move(cells));
}

std::uint64_t World::hash() const { return impl_->hash; }

}  // namespace comptonaut
