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
#include "world/build_octree.h"
#include "world/occupied_voxels.h"
#include "world/octomap_file.h"
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

/// The occupied leaves as rays need them; nullptr: there are none.
std::unique_ptr<OccupiedVoxels> occupied_voxels(const octomap::OcTree& tree) {
  struct Leaf {
    VoxelKey corner;
    int size;
  };
  std::vector<Leaf> leaves;
  Eigen::Vector3i first = Eigen::Vector3i::Constant(1 << 20), last = -first;
  const auto whole = [&](double x_m) { return static_cast<std::int32_t>(std::lround(x_m / tree.getResolution())); };
  for (auto it = tree.begin_leafs(), end = tree.end_leafs(); it != end; ++it) {
    if (!tree.isNodeOccupied(*it)) continue;
    const double half_m = 0.5 * it.getSize();
    const VoxelKey corner{whole(it.getX() - half_m), whole(it.getY() - half_m), whole(it.getZ() - half_m)};
    const int size = whole(it.getSize());
    first = first.cwiseMin(Eigen::Vector3i(corner.x, corner.y, corner.z));
    last = last.cwiseMax(Eigen::Vector3i(corner.x + size - 1, corner.y + size - 1, corner.z + size - 1));
    leaves.push_back({corner, size});
  }
  if (leaves.empty()) return nullptr;
  auto voxels = std::make_unique<OccupiedVoxels>(tree.getResolution(), VoxelKey{first.x(), first.y(), first.z()},
                                                 VoxelKey{last.x(), last.y(), last.z()});
  for (const Leaf& leaf : leaves) voxels->fill(leaf.corner, leaf.size);
  return voxels;
}

}  // namespace

struct World::Impl {
  double ground_z_m = 0.0;                   ///< of flat ground
  std::unique_ptr<octomap::OcTree> tree;     ///< null: flat ground
  std::unique_ptr<OccupiedVoxels> occupied;  ///< of the tree; null: none are
  UnknownSpace unknown = UnknownSpace::kClosed;
  std::uint64_t hash = 0;

  [[nodiscard]] Cube root() const {
    const Eigen::Vector3d half = Eigen::Vector3d::Constant(std::ldexp(tree->getResolution(), 15));
    return {.node = tree->getRoot(), .box = {.min_W = -half, .max_W = half}};
  }
  [[nodiscard]] bool closed(Occupancy occupancy) const {
    return occupancy == Occupancy::kOccupied || (occupancy == Occupancy::kUnknown && unknown == UnknownSpace::kClosed);
  }
  bool any_closed(const Cube& cube, const Box& region, const std::function<bool(const Box&)>& hit) const {
    if (!cube.box.touches(region)) return false;
    if (cube.leaf(*tree)) return closed(cube.occupancy(*tree)) && hit(cube.box);
    for (unsigned i = 0; i < 8; ++i) {
      if (any_closed(cube.child(*tree, i), region, hit)) return true;
    }
    return false;
  }
  /// Goes down the column at (x, y); `open_above` is whether what lies on top of the cube is free.
  std::optional<double> ground_in(const Cube& cube, double x_m, double y_m, bool& open_above) const {
    if (cube.leaf(*tree)) {
      const bool ground = open_above && cube.occupancy(*tree) == Occupancy::kOccupied;
      open_above = !closed(cube.occupancy(*tree));
      return ground ? std::optional(cube.box.max_W.z()) : std::nullopt;
    }
    const Eigen::Vector3d middle = 0.5 * (cube.box.min_W + cube.box.max_W);
    const unsigned column = (x_m >= middle.x() ? 1U : 0U) | (y_m >= middle.y() ? 2U : 0U);
    const auto upper = ground_in(cube.child(*tree, column | 4U), x_m, y_m, open_above);
    return upper ? upper : ground_in(cube.child(*tree, column), x_m, y_m, open_above);
  }
};

World::World(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}

World World::flat(double ground_z_m) {
  if (!std::isfinite(ground_z_m)) throw std::invalid_argument(fmt::format("height of the ground: {}", ground_z_m));
  auto impl = std::make_shared<Impl>();
  impl->ground_z_m = ground_z_m;
  Fnv1a hash;
  hash.add(ground_z_m);
  impl->hash = hash.value();
  return World(std::move(impl));
}

World World::load(const std::filesystem::path& file, UnknownSpace unknown) {
  auto impl = std::make_unique<Impl>();
  impl->tree = read_octomap(file);
  impl->unknown = unknown;
  try {
    return of_tree(std::move(impl));
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(fmt::format("{}: {}", file.string(), error.what()));
  }
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
  impl->occupied = occupied_voxels(*impl->tree);
  Fnv1a hash;
  hash.add(impl->tree->getResolution());
  hash_cube(*impl->tree, impl->root(), hash);
  impl->hash = hash.value();
  return World(std::move(impl));
}

void World::save(const std::filesystem::path& file) const {
  if (is_flat()) throw std::logic_error("flat ground has no OctoMap");
  if (!impl_->tree->writeBinaryConst(file.string())) {
    throw std::runtime_error(fmt::format("{}: cannot write the OctoMap file", file.string()));
  }
}

bool World::is_flat() const { return impl_->tree == nullptr; }

double World::voxel_m() const {
  if (is_flat()) throw std::logic_error("flat ground has no voxels");
  return impl_->tree->getResolution();
}

double World::occupied_m(const Eigen::Vector3d& a_W, const Eigen::Vector3d& b_W, double enough_m) const {
  if (impl_->tree) return impl_->occupied ? impl_->occupied->length_m(a_W, b_W, enough_m) : 0.0;
  const double a_m = impl_->ground_z_m - a_W.z(), b_m = impl_->ground_z_m - b_W.z();  // below the ground
  if (a_m <= 0.0 && b_m <= 0.0) return 0.0;
  const double share = a_m > 0.0 && b_m > 0.0 ? 1.0 : std::max(a_m, b_m) / std::abs(a_m - b_m);
  return share * (b_W - a_W).norm();
}

Occupancy World::at(const Eigen::Vector3d& p_W) const {
  if (!impl_->tree) return p_W.z() <= impl_->ground_z_m ? Occupancy::kOccupied : Occupancy::kFree;
  const Box all = impl_->root().box;
  const bool inside = (p_W.array() >= all.min_W.array()).all() && (p_W.array() < all.max_W.array()).all();
  const auto* node = inside ? impl_->tree->search(p_W.x(), p_W.y(), p_W.z()) : nullptr;
  return Cube{.node = node, .box = {}}.occupancy(*impl_->tree);
}

bool World::closed(const Eigen::Vector3d& p_W) const { return impl_->closed(at(p_W)); }

bool World::closed(const Box& region) const {
  return any_closed(region, [](const Box&) { return true; });
}

bool World::any_closed(const Box& region, const std::function<bool(const Box&)>& hit) const {
  constexpr double kFar_m = 1e6;
  if (impl_->tree) return impl_->any_closed(impl_->root(), region, hit);
  const Box ground{.min_W = {-kFar_m, -kFar_m, -kFar_m}, .max_W = {kFar_m, kFar_m, impl_->ground_z_m}};
  return ground.touches(region) && hit(ground);
}

std::optional<double> World::ground_height_m(double x_m, double y_m) const {
  if (!impl_->tree) return impl_->ground_z_m;
  const Cube root = impl_->root();
  const bool inside =
      x_m >= root.box.min_W.x() && x_m < root.box.max_W.x() && y_m >= root.box.min_W.y() && y_m < root.box.max_W.y();
  bool open_above = !impl_->closed(Occupancy::kUnknown);
  return inside ? impl_->ground_in(root, x_m, y_m, open_above) : std::nullopt;
}

Cells World::surface_cells(const Area& area, double cell_m) const {
  const Cells columns = flat_cells(area, cell_m, impl_->ground_z_m);
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
