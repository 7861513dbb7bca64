// SPDX-License-Identifier: BSD-3-Clause
#include "search/lookahead.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace comptonaut {
namespace {

constexpr int kDirections = 16;
constexpr double kStop_s = 1.0;
constexpr double kShortest_m = 2.0;  ///< of a leg
constexpr double kTurnShare = 0.5;   ///< of the time of a turn on the spot: the MAV gets on meanwhile

/// Where a next leg might lead. Distances double from a square and a half to what one second at full speed may cross.
std::vector<Eigen::Vector3d> candidates(const Lookahead& lookahead, const Path& path,
                                        std::span<const SourceEstimate> sources) {
  const CoarseGround& ground = lookahead.ground;
  std::vector<Eigen::Vector3d> result;
  const auto add = [&](double x_m, double y_m) {
    const Eigen::Vector3d p_W(x_m, y_m, 0.0);
    const double z_m = ground.p_W(ground.at(p_W)).z() + lookahead.set_height_m;
    result.emplace_back(x_m, y_m, z_m);
  };
  for (int k = 0; k < kDirections; ++k) {
    const double angle_rad = 2.0 * std::numbers::pi * k / kDirections;
    for (double length_m = lookahead.config.leg_min_m; length_m <= lookahead.config.leg_max_m; length_m *= 2.0) {
      const Eigen::Vector2d to =
          path.p_W.head<2>() + length_m * Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad));
      if (ground.area().contains(to.x(), to.y())) add(to.x(), to.y());
    }
  }
  for (const SourceEstimate& source : sources) {
    const double away_m = (source.p_W - path.p_W).head<2>().norm();
    if (away_m > kShortest_m && away_m < 2.0 * lookahead.config.leg_max_m) add(source.p_W.x(), source.p_W.y());
  }
  if (!ground.area().contains(path.p_W.x(), path.p_W.y())) {
    const Eigen::Vector3d& p_W = ground.p_W(ground.at(path.p_W));
    add(p_W.x(), p_W.y());
  }
  return result;
}

void look(const Lookahead& lookahead, Path& path, const Eigen::Vector3d& p_W, double time_s) {
  const auto i = static_cast<Eigen::Index>(lookahead.ground.at(p_W));
  path.known += static_cast<float>(time_s) * lookahead.prospect.per_s.col(i);
  path.time_s += time_s;
}

void stop(const Lookahead& lookahead, Path& path) {
  look(lookahead, path, path.p_W, kStop_s + path.v_W.norm() / lookahead.config.acceleration_m_s2);
  path.v_W.setZero();
}

void fly(const Lookahead& lookahead, Path& path, const Eigen::Vector3d& way_W) {
  const double a = lookahead.config.acceleration_m_s2, length_m = way_W.norm();
  const Eigen::Vector3d direction_W = way_W / length_m;
  const double start_m_s = std::clamp(path.v_W.dot(direction_W), 0.0, lookahead.speed_max_m_s);
  look(lookahead, path, path.p_W, kTurnShare * (path.v_W - start_m_s * direction_W).norm() / a);
  const int steps = static_cast<int>(std::ceil(length_m / lookahead.ground.edge_m()));
  const double step_m = length_m / steps;
  const auto speed_at = [&](double way_m) {
    return std::min(lookahead.speed_max_m_s, std::sqrt(start_m_s * start_m_s + 2.0 * a * way_m));
  };
  for (int step = 0; step < steps; ++step) {
    const double mean_m_s = 0.5 * (speed_at(step * step_m) + speed_at((step + 1) * step_m));
    look(lookahead, path, path.p_W + (step + 0.5) * step_m * direction_W, step_m / mean_m_s);
  }
  path.p_W += way_W;
  path.v_W = speed_at(length_m) * direction_W;
}

}  // namespace

Path with_leg(const Lookahead& lookahead, const Path& path, const Eigen::Vector3d& to_W) {
  Path longer = path;
  const Eigen::Vector3d way_W = to_W - path.p_W;
  if (way_W.norm() > 1e-6) {
    fly(lookahead, longer, way_W);
    longer.points_W.push_back(to_W);
  } else {
    stop(lookahead, longer);
  }
  longer.gain += worth(lookahead.prospect, longer.known) - worth(lookahead.prospect, path.known);
  return longer;
}

Path best_path(const Lookahead& lookahead, const Path& start, std::span<const SourceEstimate> sources) {
  std::vector<Path> kept{start};
  for (int leg = 0; leg < lookahead.config.legs_ahead; ++leg) {
    std::vector<Path> longer;
    for (const Path& path : kept) {
      longer.push_back(with_leg(lookahead, path, path.p_W));
      for (const Eigen::Vector3d& to_W : candidates(lookahead, path, sources)) {
        if (path.points_W.empty() && !lookahead.free(to_W)) continue;
        longer.push_back(with_leg(lookahead, path, to_W));
      }
    }
    std::stable_sort(longer.begin(), longer.end(),
                     [](const Path& a, const Path& b) { return a.gain_per_s() > b.gain_per_s(); });
    longer.resize(std::min<std::size_t>(longer.size(), static_cast<std::size_t>(lookahead.config.paths_kept)));
    kept = std::move(longer);
  }
  return kept.front();
}

}  // namespace comptonaut
