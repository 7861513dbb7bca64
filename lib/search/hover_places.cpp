// SPDX-License-Identifier: BSD-3-Clause
#include "search/hover_places.h"

namespace comptonaut {
namespace {

constexpr int kTries = 3;  ///< to each side of the middle

std::optional<Eigen::Vector3d> nearest_to_middle(const CoarseGround& ground, std::size_t i, const World& world,
                                                 const RouteConfig& route, double set_height_m) {
  const Eigen::Vector3d middle_W = ground.p_W(i) + set_height_m * Eigen::Vector3d::UnitZ();
  std::optional<Eigen::Vector3d> nearest;
  for (int y = -kTries; y <= kTries; ++y) {
    for (int x = -kTries; x <= kTries; ++x) {
      const Eigen::Vector3d p_W = middle_W + 0.5 * ground.edge_m() / (kTries + 1) * Eigen::Vector3d(x, y, 0.0);
      const bool nearer = !nearest || (p_W - middle_W).norm() < (*nearest - middle_W).norm();
      if (nearer && ground.at(p_W) == i && route.fence.contains(p_W) && may_hover(world, route, p_W)) nearest = p_W;
    }
  }
  return nearest;
}

}  // namespace

HoverPlaces hover_places(const CoarseGround& ground, const World& world, const RouteConfig& route,
                         double set_height_m) {
  HoverPlaces places;
  for (std::size_t i = 0; i < ground.size(); ++i) {
    const Eigen::Vector3d middle_W = ground.p_W(i) + set_height_m * Eigen::Vector3d::UnitZ();
    const bool open = route.fence.contains(middle_W) && may_hover(world, route, middle_W);
    places.push_back(open ? middle_W : nearest_to_middle(ground, i, world, route, set_height_m));
  }
  return places;
}

}  // namespace comptonaut
