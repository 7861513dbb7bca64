// SPDX-License-Identifier: BSD-3-Clause
#include "search/courses.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "core/segment.h"
#include "flight/route.h"

namespace comptonaut {
namespace {

using Points = std::vector<Eigen::Vector3d>;

constexpr double kAhead_s = 15.0;  ///< of flight at full speed: more than a plan holds

double length_m(Eigen::Vector3d from_W, const Points& points_W) {
  double sum_m = 0.0;
  for (const Eigen::Vector3d& p_W : points_W) {
    sum_m += (p_W - from_W).norm();
    from_W = p_W;
  }
  return sum_m;
}

/// Horizontal distance of a point from the stretch a .. b.
double distance_m(const Eigen::Vector3d& point, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector2d p = point.head<2>();
  return (p - nearest_on<2>(a.head<2>(), b.head<2>(), p)).norm();
}

/// The way to the target without its start.
std::optional<Points> way(const SearchState& state, const SearchConfig& config, const Eigen::Vector3d& start_W,
                          const Eigen::Vector3d& target_W, std::span<const Leg> taken) {
  auto route = find_route(state.world, config.route, start_W, target_W, taken);
  if (route) route->erase(route->begin());
  return route;
}

/// The way to the first target that has one, which is moved to the front. nullopt: none has.
std::optional<Points> first_way(const SearchState& state, const SearchConfig& config, const Eigen::Vector3d& start_W,
                                std::span<const Leg> taken, Points& targets) {
  const auto tries = std::min<std::ptrdiff_t>(std::ssize(targets), config.route_tries);
  for (auto it = targets.begin(); it != targets.begin() + tries; ++it) {
    auto points = way(state, config, start_W, *it, taken);
    if (!points) continue;
    std::rotate(targets.begin(), it, it + 1);
    return points;
  }
  return std::nullopt;
}

/// Says of the course that no way leads to the target, and why.
void tell_no_way(const SearchState& state, const SearchConfig& config, const Eigen::Vector3d& start_W,
                 const Eigen::Vector3d& target_W, Course& course) {
  NoRoute none = why_no_route(state.world, config.route, start_W, target_W);
  course.status =
      fmt::format("no way to ({:.1f}, {:.1f}, {:.1f}): {}", target_W.x(), target_W.y(), target_W.z(), none.why);
  course.unreachable = none.without_others;
  course.pocket_W = std::move(none.pocket_W);
}

/// Goes on to the targets after the first, as far as a MAV may fly before all is thought of anew.
void append_legs(const SearchState& state, const SearchConfig& config, const Eigen::Vector3d& start_W,
                 const Points& targets, Course& course) {
  const auto n = std::min<std::size_t>(targets.size(), static_cast<std::size_t>(config.legs_ahead));
  const double far_m = kAhead_s * state.facts.speed_max_m_s;
  for (std::size_t i = 1; i < n && length_m(start_W, course.points_W) < far_m; ++i) {
    const auto points = way(state, config, targets[i - 1], targets[i], {});
    if (!points) {
      tell_no_way(state, config, targets[i - 1], targets[i], course);
      course.unreachable = false;  // that is of the first target
      return;
    }
    course.points_W.insert(course.points_W.end(), points->begin(), points->end());
  }
}

/// The legs from `start_W` through the points; a MAV that holds takes up its place.
void take_legs(const Eigen::Vector3d& start_W, const Points& points_W, std::vector<Leg>& taken) {
  if (points_W.empty()) taken.push_back({.from_W = start_W, .to_W = start_W});
  Eigen::Vector3d from_W = start_W;
  for (const Eigen::Vector3d& to_W : points_W) {
    taken.push_back({.from_W = from_W, .to_W = to_W});
    from_W = to_W;
  }
}

/// The ways that are taken, and where MAVs of a higher number stand: two that each have their way through the other
/// one's place would wait for ever.
std::vector<Leg> in_the_way(const SearchState& state, const Searcher& mav, std::vector<Leg> taken) {
  constexpr double kStands_m_s = 0.5;
  for (const Searcher& other : state.mavs) {
    const bool stands = other.mav > mav.mav && other.v_W.norm() < kStands_m_s;
    if (stands) taken.push_back({.from_W = other.p_W, .to_W = other.p_W});
  }
  return taken;
}

/// One MAV's course; `taken` grows by its first way.
Course make_course(const SearchState& state, const SearchConfig& config, const Searcher& mav, Points& targets,
                   std::vector<Leg>& taken) {
  Course course{.points_W = {}, .status = "nothing to visit"};
  if (!targets.empty()) {
    auto points = way(state, config, mav.p_W, targets.front(), in_the_way(state, mav, taken));
    if (!points) points = first_way(state, config, mav.p_W, taken, targets);  // who stands there may leave
    course.points_W = points.value_or(Points{});
    course.status = "searching";
    if (!points) tell_no_way(state, config, mav.p_W, targets.front(), course);
  }
  take_legs(mav.p_W, course.points_W, taken);
  if (!course.points_W.empty()) append_legs(state, config, mav.p_W, targets, course);
  return course;
}

}  // namespace

std::vector<Eigen::Vector3d> take_reached(Points& targets, const Points& track_W, double reach_m) {
  std::size_t reached = 0;
  for (std::size_t i = 0; i < track_W.size(); ++i) {
    const Eigen::Vector3d& before = track_W[i > 0 ? i - 1 : 0];
    while (reached < targets.size() && distance_m(targets[reached], before, track_W[i]) <= reach_m) ++reached;
  }
  const auto end = targets.begin() + static_cast<std::ptrdiff_t>(reached);
  Points taken(targets.begin(), end);
  targets.erase(targets.begin(), end);
  return taken;
}

SearchConfig with_keep_out(std::span<const SourceEstimate> sources, SearchConfig config) {
  if (config.keep_out.activity_min_Bq <= 0.0) return config;
  for (const SourceEstimate& source : sources) {
    if (source.activity_Bq < config.keep_out.activity_min_Bq) continue;
    config.route.fence.keep_out.push_back({source.p_W.head<2>(), config.keep_out.radius_m});
  }
  return config;
}

std::vector<Course> make_courses(const SearchState& state, const SearchConfig& as_configured, Targets& targets) {
  const SearchConfig config = with_keep_out(state.sources, as_configured);
  for (const Searcher& mav : state.mavs) {
    for (Eigen::Vector3d& p_W : targets[mav.mav]) p_W = config.route.fence.nearest_allowed(p_W);
  }
  std::vector<Course> courses;
  std::vector<Leg> taken;
  for (const Searcher& mav : state.mavs) {
    courses.push_back(make_course(state, config, mav, targets[mav.mav], taken));
  }
  return courses;
}

}  // namespace comptonaut
