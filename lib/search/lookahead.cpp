// SPDX-License-Identifier: BSD-3-Clause
#include "search/lookahead.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace comptonaut {
namespace {

constexpr int kDirections = 16;
constexpr double kShortest_m = 2.0;  ///< of a leg to a source

/// Where a leg to above (x, y) may end; nullopt: nowhere.
std::optional<Eigen::Vector3d> end_above(const Lookahead& lookahead, double x_m, double y_m) {
  const CoarseGround& ground = lookahead.ground;
  const std::size_t square = ground.at({x_m, y_m, 0.0});
  if (!ground.area().contains(x_m, y_m) || !lookahead.prospect.flyable[square]) return std::nullopt;
  return lookahead.hover_at({x_m, y_m, ground.p_W(square).z() + lookahead.set_height_m});
}

/// Time above a point of a leg.
void look(const Lookahead& lookahead, FlightPath& path, const Eigen::Vector3d& p_W, double time_s, Looks& looks) {
  looks.add(lookahead.prospect.views[lookahead.ground.at(p_W)], time_s);
  path.time_s += time_s;
}

/// The fastest that a corner between two directions can be taken, staying within corner_deviation_max_m of it (as in
/// lib/flight/profile.cpp).
double corner_speed_m_s(const Lookahead& lookahead, double turn) {
  const double fastest = std::sqrt(8.0 * lookahead.acceleration_max_m_s2 * lookahead.corner_deviation_max_m);
  return turn * lookahead.speed_max_m_s > fastest ? fastest / turn : lookahead.speed_max_m_s;
}

/// Turns into a direction; the speed with which the leg there begins.
double turn(const Lookahead& lookahead, FlightPath& path, const Eigen::Vector3d& direction_W, Looks& looks) {
  const double a = lookahead.acceleration_max_m_s2, speed = path.v_W.norm();
  const double along = std::clamp(path.v_W.dot(direction_W), 0.0, lookahead.speed_max_m_s);
  if (path.time_s == 0.0) {  // in flight: the sideways motion has to be stopped, and it gets on meanwhile
    look(lookahead, path, path.p_W, 0.5 * (path.v_W - along * direction_W).norm() / a, looks);
    return along;
  }
  if (speed == 0.0) return 0.0;
  const double corner = std::min(speed, corner_speed_m_s(lookahead, (direction_W - path.v_W / speed).norm()));
  look(lookahead, path, path.p_W, (speed - corner) * (speed - corner) / (2.0 * a * speed), looks);  // lost by braking
  return corner;
}

void fly(const Lookahead& lookahead, FlightPath& path, const Eigen::Vector3d& way_W, Looks& looks) {
  const double a = lookahead.acceleration_max_m_s2, length_m = way_W.norm();
  const Eigen::Vector3d direction_W = way_W / length_m;
  const double start_m_s = turn(lookahead, path, direction_W, looks);
  const int steps = static_cast<int>(std::ceil(length_m / lookahead.ground.edge_m()));
  const double step_m = length_m / steps;
  const auto speed_at = [&](double way_m) {
    return std::min(lookahead.speed_max_m_s, std::sqrt(start_m_s * start_m_s + 2.0 * a * way_m));
  };
  for (int step = 0; step < steps; ++step) {
    const double mean_m_s = 0.5 * (speed_at(step * step_m) + speed_at((step + 1) * step_m));
    look(lookahead, path, path.p_W + (step + 0.5) * step_m * direction_W, step_m / mean_m_s, looks);
  }
  path.p_W += way_W;
  path.v_W = speed_at(length_m) * direction_W;
}

/// Adds to `longer` the straight ways on in one direction, in stretches, of doubled numbers of them.
void add_ray(const Lookahead& lookahead, const FlightPath& path, double angle_rad, std::vector<FlightPath>& longer) {
  const InformationConfig& config = lookahead.config;
  const Eigen::Vector2d step = config.stretch_m * Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad));
  FlightPath ray = path;
  for (int stretch = 1, next = 1; stretch * config.stretch_m <= config.leg_max_m; ++stretch) {
    const Eigen::Vector2d to = ray.p_W.head<2>() + step;
    const auto to_W = end_above(lookahead, to.x(), to.y());
    if (!to_W || (ray.points_W.empty() && !lookahead.free(*to_W))) return;
    ray = with_leg(lookahead, std::move(ray), *to_W);
    if (stretch != next) continue;
    longer.push_back(ray);
    next *= 2;
  }
}

void add_way_to(const Lookahead& lookahead, const FlightPath& path, const Eigen::Vector3d& to_W,
                std::vector<FlightPath>& longer) {
  const double stretches = std::ceil((to_W - path.p_W).norm() / lookahead.config.stretch_m);
  const Eigen::Vector3d step_W = (to_W - path.p_W) / stretches;
  if (path.points_W.empty() && !lookahead.free(path.p_W + step_W)) return;
  FlightPath way = path;
  for (int k = 0; k < stretches; ++k) way = with_leg(lookahead, std::move(way), way.p_W + step_W);
  longer.push_back(std::move(way));
}

/// All the ways in which a flight may go on.
void add_longer(const Lookahead& lookahead, const FlightPath& path, std::span<const SourceEstimate> sources,
                std::vector<FlightPath>& longer) {
  const CoarseGround& ground = lookahead.ground;
  for (int k = 0; k < kDirections; ++k) add_ray(lookahead, path, 2.0 * std::numbers::pi * k / kDirections, longer);
  for (const SourceEstimate& source : sources) {
    const double away_m = (source.p_W - path.p_W).head<2>().norm();
    const bool near = away_m > kShortest_m && away_m < 2.0 * lookahead.config.leg_max_m;
    const auto to_W = end_above(lookahead, source.p_W.x(), source.p_W.y());
    if (near && to_W) add_way_to(lookahead, path, *to_W, longer);
  }
  if (ground.area().contains(path.p_W.x(), path.p_W.y())) return;
  const Eigen::Vector3d inside_W = ground.p_W(ground.at(path.p_W)) + lookahead.set_height_m * Eigen::Vector3d::UnitZ();
  add_way_to(lookahead, path, lookahead.hover_at(inside_W).value_or(inside_W), longer);
}

}  // namespace

FlightPath start_flight(const Eigen::Vector3d& p_W, const Eigen::Vector3d& v_W, Eigen::ArrayXf open) {
  return {.points_W = {}, .p_W = p_W, .v_W = v_W, .open = std::move(open)};
}

FlightPath with_leg(const Lookahead& lookahead, FlightPath path, const Eigen::Vector3d& to_W) {
  const double begin_s = path.time_s, patience_s = lookahead.config.patience_s;
  const Eigen::Vector3d way_W = to_W - path.p_W;
  path.points_W.push_back(to_W);
  if (way_W.norm() < 1e-6) return path;
  Looks looks(path.open.size());
  fly(lookahead, path, way_W, looks);
  path.gain += std::exp(-0.5 * (begin_s + path.time_s) / patience_s) * looks.answer(path.open);
  path.score = path.gain / (patience_s * (1.0 - std::exp(-path.time_s / patience_s)));
  return path;
}

FlightPath best_flight(const Lookahead& lookahead, const FlightPath& start, std::span<const SourceEstimate> sources) {
  const InformationConfig& config = lookahead.config;
  std::vector<FlightPath> kept{start};
  const auto short_of = [&](const FlightPath& path) { return path.time_s < config.horizon_s; };
  for (int leg = 0; leg < config.legs_ahead && std::ranges::any_of(kept, short_of); ++leg) {
    std::vector<FlightPath> longer;
    for (const FlightPath& path : kept) {
      if (short_of(path)) {
        add_longer(lookahead, path, sources, longer);
      } else {
        longer.push_back(path);
      }
    }
    if (longer.empty()) break;
    std::ranges::stable_sort(longer, std::ranges::greater{}, &FlightPath::score);
    longer.resize(std::min<std::size_t>(longer.size(), static_cast<std::size_t>(config.paths_kept)));
    kept = std::move(longer);
  }
  return kept.front();
}

FlightPath polished(const Lookahead& lookahead, const FlightPath& start, FlightPath path) {
  for (const double shift_m : {0.5 * lookahead.config.stretch_m, 0.25 * lookahead.config.stretch_m}) {
    FlightPath before = start;
    for (std::size_t i = 0; i < path.points_W.size(); ++i) {
      for (int k = 0; k < 4; ++k) {
        const double angle_rad = 0.5 * std::numbers::pi * k;
        const double x_m = path.points_W[i].x() + shift_m * std::cos(angle_rad);
        const double y_m = path.points_W[i].y() + shift_m * std::sin(angle_rad);
        const auto shifted_W = end_above(lookahead, x_m, y_m);
        if (!shifted_W || (i == 0 && !lookahead.free(*shifted_W))) continue;
        FlightPath other = with_leg(lookahead, before, *shifted_W);
        for (std::size_t j = i + 1; j < path.points_W.size(); ++j) {
          other = with_leg(lookahead, std::move(other), path.points_W[j]);
        }
        if (other.score > path.score) path = std::move(other);
      }
      before = with_leg(lookahead, std::move(before), path.points_W[i]);
    }
  }
  return path;
}

}  // namespace comptonaut
