// SPDX-License-Identifier: BSD-3-Clause
#include "search/werner2024.h"

#include <algorithm>
#include <limits>

#include "radiation/local_maxima.h"
#include "search/kmeans.h"
#include "search/tour.h"

namespace comptonaut {
namespace {

using Points = std::vector<Eigen::Vector3d>;

constexpr int kExploreRounds = 10;
constexpr int kDoublingsMax = 200;  ///< from any threshold to beyond any sensitivity

std::vector<Eigen::Vector2d> flat(const Points& points) {
  std::vector<Eigen::Vector2d> result;
  for (const Eigen::Vector3d& p : points) result.emplace_back(p.head<2>());
  return result;
}

/// Local maxima of lambda that have not been looked at enough.
Points exploitation(const SearchState& state, double s_max_s) {
  Points points;
  for (const std::uint32_t j : local_maxima(state.cells, state.lambda_Bq)) {
    if (state.sensitivity_s[j] < s_max_s) points.push_back(state.cells.p_W(j));
  }
  return points;
}

/// Cells that have hardly been looked at, reduced to at most k by K-means: of each cluster the cell nearest to its
/// centre.
Points exploration(const SearchState& state, double s_min_s, std::size_t k) {
  Points cells;
  for (std::size_t j = 0; j < state.cells.size(); ++j) {
    if (state.sensitivity_s[j] < s_min_s) cells.push_back(state.cells.p_W(j));
  }
  if (cells.size() <= k) return cells;
  const auto points = flat(cells);
  const Clusters clusters = kmeans(points, spread_seeds(points, k), kExploreRounds);
  std::vector<std::size_t> best(k, cells.size());
  std::vector<double> best_m2(k, std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::size_t c = clusters.cluster_of[i];
    const double m2 = (points[i] - clusters.centres[c]).squaredNorm();
    if (m2 < best_m2[c]) best[c] = i, best_m2[c] = m2;
  }
  Points reduced;
  for (const std::size_t i : best) {
    if (i < cells.size()) reduced.push_back(cells[i]);
  }
  return reduced;
}

/// Shares the waypoints out, one cluster per MAV, seeded where the MAVs are.
std::vector<Points> share_out(const Points& waypoints, std::span<const Searcher> mavs) {
  std::vector<Eigen::Vector2d> seeds;
  for (const Searcher& mav : mavs) seeds.emplace_back(mav.p_W.head<2>());
  const Clusters clusters = kmeans(flat(waypoints), seeds);
  std::vector<Points> shares(mavs.size());
  for (std::size_t i = 0; i < waypoints.size(); ++i) shares[clusters.cluster_of[i]].push_back(waypoints[i]);
  return shares;
}

}  // namespace

Werner2024::Werner2024(const SearchConfig& config)
    : config_(config), s_min_s_(config.werner2024.s_min_s), s_max_s_(config.werner2024.s_max_s) {}

std::vector<Course> Werner2024::plan(const SearchState& state) {
  remember_visits(state);
  if (lists_are_due(state)) make_lists(state);
  return make_courses(state, config_, targets_);
}

void Werner2024::remember_visits(const SearchState& state) {
  for (const Searcher& mav : state.mavs) {
    for (const Eigen::Vector3d& p_W : take_reached(targets_[mav.mav], mav.track_W, config_.reach_m)) {
      visits_.push_back({.p_W = p_W, .utime = state.utime});
    }
  }
  std::erase_if(visits_, [&](const Visit& visit) {
    return seconds(state.utime - visit.utime) > config_.werner2024.visit_memory_s;
  });
}

bool Werner2024::lists_are_due(const SearchState& state) const {
  const bool old = seconds(state.utime - listed_utime_) >= config_.werner2024.replan_period_s;
  return old || std::any_of(state.mavs.begin(), state.mavs.end(),
                            [&](const Searcher& mav) { return targets_.at(mav.mav).empty(); });
}

void Werner2024::make_lists(const SearchState& state) {
  listed_utime_ = state.utime;
  for (auto& [mav, list] : targets_) list.resize(std::min<std::size_t>(list.size(), 1));
  const std::vector<Points> shares = share_out(waypoints(state), state.mavs);
  for (std::size_t i = 0; i < state.mavs.size(); ++i) {
    Points& list = targets_[state.mavs[i].mav];
    const Eigen::Vector3d start_W = list.empty() ? state.mavs[i].p_W : list.front();
    for (const std::size_t k : open_tour(start_W, shares[i])) list.push_back(shares[i][k]);
  }
}

/// At least one for each MAV, as long as there are so many cells.
Points Werner2024::waypoints(const SearchState& state) {
  for (int i = 0; i < kDoublingsMax; ++i) {
    const Points all = candidates(state);
    Points fresh = all;
    std::erase_if(fresh, [&](const Eigen::Vector3d& p_W) { return recently_visited(p_W); });
    if (fresh.size() >= state.mavs.size()) return fresh;
    if (all.size() >= state.mavs.size()) return all;
    s_min_s_ *= 2.0;
    s_max_s_ *= 2.0;
  }
  return candidates(state);
}

Points Werner2024::candidates(const SearchState& state) const {
  Points points = exploitation(state, s_max_s_);
  const auto k = static_cast<std::size_t>(config_.werner2024.explore_clusters);
  const Points explore = exploration(state, s_min_s_, k);
  points.insert(points.end(), explore.begin(), explore.end());
  for (Eigen::Vector3d& p_W : points) p_W.z() += config_.set_height_m;
  const auto is_target = [&](const Eigen::Vector3d& p_W) {
    return std::any_of(targets_.begin(), targets_.end(), [&](const auto& list) {
      return !list.second.empty() && (list.second.front() - p_W).norm() <= config_.werner2024.visit_radius_m;
    });
  };
  std::erase_if(points, is_target);  // somebody is on the way there
  return points;
}

bool Werner2024::recently_visited(const Eigen::Vector3d& p_W) const {
  return std::any_of(visits_.begin(), visits_.end(),
                     [&](const Visit& visit) { return (visit.p_W - p_W).norm() <= config_.werner2024.visit_radius_m; });
}

}  // namespace comptonaut
