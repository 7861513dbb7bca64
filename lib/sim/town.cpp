// SPDX-License-Identifier: BSD-3-Clause
#include "sim/town.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

#include "core/random.h"
#include "nodes/coordinator_config.h"

namespace comptonaut {
namespace {

constexpr double kStartStrip_m = 6.0;  // along the south side
constexpr double kWall_m = 0.5;
constexpr int kTries = 2000;
constexpr int kLayouts = 100;

void check(const TownPlan& plan) {
  const auto within = [](const char* what, double value, double min, double max) {
    if (value >= min && value <= max) return;
    throw std::invalid_argument(fmt::format("a town's {} is {}, must be {} to {}", what, value, min, max));
  };
  within("length from west to east", plan.x_m, 20.0, 200.0);
  within("length from south to north", plan.y_m, 20.0, 200.0);
  within("height", plan.z_m, 8.0, 60.0);
  within("number of buildings", plan.buildings, 1, 200);
  within("number of sources", plan.sources, 1, 32);
  within("number of drones", plan.drones, 1, kMaxTeam);
  within("size for its drones, which begin 4 m apart,", plan.x_m, 4.0 * plan.drones, 200.0);
}

/// A random length, in whole half metres.
double length_m(Random& random, double min_m, double max_m) {
  return 0.5 * std::round(2.0 * random.uniform(min_m, max_m));
}

Box box_at(double x_m, double y_m, double width_m, double depth_m, double height_m) {
  return {.min_W = {x_m, y_m, 0.0}, .max_W = {x_m + width_m, y_m + depth_m, height_m}};
}

/// Its parts, the first corner at the origin.
std::vector<Box> random_building(const TownPlan& plan, Random& random) {
  const double kind = random.uniform();
  const double tall_m = std::min(10.0, plan.z_m - 5.0);
  if (kind < 0.5) {
    const double width_m = length_m(random, 5, 12), depth_m = length_m(random, 5, 12);
    return {box_at(0, 0, width_m, depth_m, length_m(random, 3, tall_m))};
  }
  if (kind < 0.75) {
    const double edge_m = length_m(random, 7, 10), height_m = length_m(random, 2.5, 3);
    const std::vector<Box> walls = {box_at(0, 0, edge_m, kWall_m, height_m), box_at(0, 0, kWall_m, edge_m, height_m),
                                    box_at(0, edge_m - kWall_m, edge_m, kWall_m, height_m),
                                    box_at(edge_m - kWall_m, 0, kWall_m, edge_m, height_m)};
    std::vector<Box> yard = walls;
    yard.erase(yard.begin() + static_cast<std::ptrdiff_t>(random() % walls.size()));
    return yard;
  }
  const double along_m = length_m(random, 8, 14), height_m = length_m(random, 2.5, 4);
  return {random.uniform() < 0.5 ? box_at(0, 0, along_m, kWall_m, height_m) : box_at(0, 0, kWall_m, along_m, height_m)};
}

Box bounds(const std::vector<Box>& parts) {
  Box all = parts.front();
  for (const Box& part : parts) {
    all.min_W = all.min_W.cwiseMin(part.min_W);
    all.max_W = all.max_W.cwiseMax(part.max_W);
  }
  return all;
}

/// Adds the building at a random free place; false where none is found.
bool place(const TownPlan& plan, std::vector<Box> parts, Random& random, std::vector<Box>& taken,
           std::vector<Box>& boxes) {
  const Eigen::Vector3d size_m = bounds(parts).max_W;
  const double x_end_m = plan.x_m - 2.0 - size_m.x(), y_end_m = plan.y_m - 2.0 - size_m.y();
  for (int i = 0; i < kTries && x_end_m > 2.0 && y_end_m > kStartStrip_m; ++i) {
    const Eigen::Vector3d corner_W(length_m(random, 2.0, x_end_m), length_m(random, kStartStrip_m, y_end_m), 0.0);
    Box around{.min_W = corner_W.array() - kStreet_m, .max_W = (corner_W + size_m).array() + kStreet_m};
    if (std::ranges::any_of(taken, [&](const Box& other) { return other.touches(around); })) continue;
    for (Box& part : parts) part.min_W += corner_W, part.max_W += corner_W;
    taken.push_back(bounds(parts));
    boxes.insert(boxes.end(), parts.begin(), parts.end());
    return true;
  }
  return false;
}

}  // namespace

std::vector<Box> town_boxes(const TownPlan& plan) {
  check(plan);
  Random random(plan.seed);
  for (int layout = 0; layout < kLayouts; ++layout) {
    std::vector<Box> taken, boxes;
    int placed = 0;
    while (placed < plan.buildings && place(plan, random_building(plan, random), random, taken, boxes)) ++placed;
    if (placed == plan.buildings) return boxes;
  }
  throw std::runtime_error(fmt::format("no room for {} buildings on {} x {} m", plan.buildings, plan.x_m, plan.y_m));
}

std::string town_yaml(const TownPlan& plan, const std::string& name) {
  std::string text = fmt::format(
      "# SPDX-License-Identifier: BSD-3-Clause\n"
      "# Houses, yards and walls: comptonaut town --seed {} --size {}x{}x{} --buildings {} --sources {} --drones {}\n"
      "# werner2024-sim.yaml explains the keys.\n"
      "name: {}\nhorizon_s: 600\narea: {{x_min_m: 0, x_max_m: {}, y_min_m: 0, y_max_m: {}}}\n"
      "world:\n  ceiling_m: {}\n  material: concrete\n  boxes:\n",
      plan.seed, plan.x_m, plan.y_m, plan.z_m, plan.buildings, plan.sources, plan.drones, name, plan.x_m, plan.y_m,
      plan.z_m);
  for (const Box& box : town_boxes(plan)) {
    fmt::format_to(std::back_inserter(text),
                   "    - {{x_min_m: {}, x_max_m: {}, y_min_m: {}, y_max_m: {}, z_max_m: {}}}\n", box.min_W.x(),
                   box.max_W.x(), box.min_W.y(), box.max_W.y(), box.max_W.z());
  }
  fmt::format_to(std::back_inserter(text),
                 "mavs: {{count: {}, speed_max_m_s: 5}}\nsources_by_seed:\n  activities_Bq: [", plan.drones);
  for (int i = 0; i < plan.sources; ++i) text += i > 0 ? ", 1.0e9" : "1.0e9";
  fmt::format_to(std::back_inserter(text), "]\n  distance_min_m: 8\n  surface_max_m: 0.1\n  behind_walls: {}\n",
                 plan.sources / 2);
  return text;
}

}  // namespace comptonaut
