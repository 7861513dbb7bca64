// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scenario.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "core/random.h"
#include "sim/streams.h"

namespace comptonaut {
namespace {

/// Whole layouts that are tried before the distances count as impossible.
constexpr int kLayouts = 1000;
constexpr int kPlacesPerSource = 100;

std::vector<double> draw_activities(const SourceDraw& draw, Random& random) {
  std::vector<double> activities = draw.activities_Bq;
  const double ratio = draw.count > 0 ? draw.activity_max_Bq / draw.activity_min_Bq : 1.0;
  for (int i = 0; i < draw.count; ++i) activities.push_back(draw.activity_min_Bq * std::pow(ratio, random.uniform()));
  return activities;
}

bool far_enough(const Scenario& scenario, const std::vector<TrueSource>& others, const Eigen::Vector3d& p_W) {
  const double distance_min_m = scenario.draw.distance_min_m;
  for (const TrueSource& other : others) {
    if ((other.p_W - p_W).norm() < distance_min_m) return false;
  }
  const auto& patch = scenario.patch;
  return !patch || std::hypot(p_W.x() - patch->x_m, p_W.y() - patch->y_m) >= patch->radius_m + distance_min_m;
}

const std::string& nuclide_of(const Scenario& scenario, std::size_t drawn) {
  const std::vector<std::string>& nuclides = scenario.draw.nuclides;
  return nuclides.empty() ? scenario.nuclide : nuclides[drawn % nuclides.size()];
}

/// Where a drawn source at (x, y) would lie; nullopt: it may not be there.
std::optional<Eigen::Vector3d> drawn_place(const Scenario& scenario, double x_m, double y_m, std::size_t drawn) {
  const auto ground_m = scenario.world.ground_height_m(x_m, y_m);
  if (!ground_m || *ground_m > scenario.draw.surface_max_m) return std::nullopt;
  const Eigen::Vector3d p_W(x_m, y_m, *ground_m + scenario.draw.height_m);
  const bool may_be_seen = drawn >= static_cast<std::size_t>(scenario.draw.behind_walls);
  return may_be_seen || hidden_share(scenario.world, p_W) >= kBehindWalls ? std::optional(p_W) : std::nullopt;
}

/// One more source at a random free place; false where none is found.
bool place(const Scenario& scenario, double activity_Bq, Random& random, std::vector<TrueSource>& sources) {
  const Area& area = scenario.area;
  const double margin_m = scenario.draw.margin_m;
  for (int i = 0; i < kPlacesPerSource; ++i) {
    const double x_m = random.uniform(area.x_min_m + margin_m, area.x_max_m - margin_m);
    const double y_m = random.uniform(area.y_min_m + margin_m, area.y_max_m - margin_m);
    const std::size_t drawn = sources.size() - scenario.sources.size();
    const auto p_W = drawn_place(scenario, x_m, y_m, drawn);
    if (!p_W || !far_enough(scenario, sources, *p_W)) continue;
    sources.push_back({.nuclide = nuclide_of(scenario, drawn), .p_W = *p_W, .activity_Bq = activity_Bq});
    return true;
  }
  return false;
}

}  // namespace

Scenario idealised(Scenario scenario) {
  scenario.mismatch = {.position_sigma_m = 0.0,
                       .attitude_sigma_rad = 0.0,
                       .boresight_sigma_rad = 0.0,
                       .response_sigma = 0.0,
                       .scatter_share = 0.0,
                       .dead_time_us = 0.0};
  scenario.traps = {};
  return scenario;
}

double hidden_share(const World& world, const Eigen::Vector3d& p_W) {
  constexpr int kPlaces = 32;
  constexpr double kAway_m = 8.0, kAbove_m = 2.0, kHides_m = 0.05;
  int hidden = 0;
  for (int i = 0; i < kPlaces; ++i) {
    const double angle_rad = 2.0 * std::numbers::pi * i / kPlaces;
    const Eigen::Vector3d from_W =
        p_W + Eigen::Vector3d(kAway_m * std::cos(angle_rad), kAway_m * std::sin(angle_rad), kAbove_m);
    if (world.occupied_m(p_W, from_W, kHides_m) > kHides_m) ++hidden;
  }
  return static_cast<double>(hidden) / kPlaces;
}

std::vector<TrueSource> draw_sources(const Scenario& scenario, std::uint64_t seed) {
  Random random = random_stream(seed, Purpose::kSources);
  const std::vector<double> activities_Bq = draw_activities(scenario.draw, random);
  for (int layout = 0; layout < kLayouts; ++layout) {
    std::vector<TrueSource> sources = scenario.sources;
    bool complete = true;
    for (const double activity_Bq : activities_Bq) complete = complete && place(scenario, activity_Bq, random, sources);
    if (complete) return sources;
  }
  throw std::runtime_error(fmt::format("scenario {}: no room for {} sources at least {} m apart{}", scenario.name,
                                       activities_Bq.size(), scenario.draw.distance_min_m,
                                       scenario.draw.behind_walls > 0 ? ", some behind walls" : ""));
}

}  // namespace comptonaut
