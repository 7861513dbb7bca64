// SPDX-License-Identifier: BSD-3-Clause
#include "search/look_first.h"

#include <algorithm>
#include <cmath>

#include "search/share_by_time.h"
#include "world/world.h"

namespace comptonaut {
namespace {

/// Places so far apart that each piece of ground is within the flight height's distance of one, nearly.
constexpr double kSpacingPerHeight = 2.0;

int steps_over(double length_m, double spacing_m) {
  return std::max(1, static_cast<int>(std::ceil(length_m / spacing_m)));
}

}  // namespace

LookFirst::LookFirst(const SearchConfig& config, std::unique_ptr<Strategy> then)
    : config_(config), then_(std::move(then)) {}

std::vector<Course> LookFirst::plan(const SearchState& state) {
  if (!listed_) list_places(state);
  share_out(state);
  std::vector<Course> courses = then_->plan(state);
  for (const Searcher& mav : state.mavs) take_reached(targets_[mav.mav], mav.track_W, config_.reach_m);
  const std::vector<Course> first = make_courses(state, config_, targets_);
  for (std::size_t i = 0; i < courses.size(); ++i) {
    std::vector<Eigen::Vector3d>& targets = targets_[state.mavs[i].mav];
    if (targets.empty()) continue;
    courses[i] = first[i];
    if (first[i].points_W.empty()) targets.erase(targets.begin());  // it has been reported; the rest may have a way
  }
  return courses;
}

void LookFirst::list_places(const SearchState& state) {
  listed_ = true;
  const double spacing_m = kSpacingPerHeight * config_.set_height_m;
  for (const Area& area : config_.look_first) {
    const double x_m = area.x_max_m - area.x_min_m, y_m = area.y_max_m - area.y_min_m;
    const int columns = steps_over(x_m, spacing_m), rows = steps_over(y_m, spacing_m);
    for (int i = 0; i < columns * rows; ++i) {
      const double x = area.x_min_m + (i % columns + 0.5) * x_m / columns;
      const double y = area.y_min_m + (i / columns + 0.5) * y_m / rows;
      const auto ground_m = state.world.ground_height_m(x, y);
      const Eigen::Vector3d p_W(x, y, ground_m.value_or(0.0) + config_.set_height_m);
      if (ground_m && config_.route.fence.contains(p_W) && !state.world.closed(p_W)) places_W_.push_back(p_W);
    }
  }
}

void LookFirst::share_out(const SearchState& state) {
  std::vector<std::int32_t> team;
  for (const Searcher& mav : state.mavs) team.push_back(mav.mav);
  if (team == team_ || team.empty()) return;
  for (const auto& [mav, targets] : targets_) places_W_.insert(places_W_.end(), targets.begin(), targets.end());
  targets_.clear();
  team_ = team;
  std::vector<Eigen::Vector3d> starts_W;
  for (const Searcher& mav : state.mavs) starts_W.push_back(mav.p_W);
  const MotionLimits limits{.speed_max_m_s = state.facts.speed_max_m_s,
                            .acceleration_max_m_s2 = state.facts.acceleration_max_m_s2};
  const auto shares = share_by_time(starts_W, places_W_, limits);
  for (std::size_t i = 0; i < team.size(); ++i) {
    for (const std::size_t p : shares[i]) targets_[team[i]].push_back(places_W_[p]);
  }
  places_W_.clear();
}

}  // namespace comptonaut
