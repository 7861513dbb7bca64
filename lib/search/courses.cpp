// SPDX-License-Identifier: BSD-3-Clause
#include "search/courses.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "flight/route.h"

namespace comptonaut {
namespace {

using Points = std::vector<Eigen::Vector3d>;

/// Horizontal distance of a point from the stretch a .. b.
double distance_m(const Eigen::Vector3d& point, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector2d along = (b - a).head<2>();
  const Eigen::Vector2d to_point = (point - a).head<2>();
  const double length_m2 = along.squaredNorm();
  const double share = length_m2 > 0.0 ? std::clamp(to_point.dot(along) / length_m2, 0.0, 1.0) : 0.0;
  return (to_point - share * along).norm();
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

std::string no_way(const Eigen::Vector3d& target_W) {
  return fmt::format("no way to ({:.1f}, {:.1f}, {:.1f})", target_W.x(), target_W.y(), target_W.z());
}

/// Goes on to the targets after the first.
void append_legs(const SearchState& state, const SearchConfig& config, const Points& targets, Course& course) {
  const auto n = std::min<std::size_t>(targets.size(), static_cast<std::size_t>(config.legs_ahead));
  for (std::size_t i = 1; i < n; ++i) {
    const auto points = way(state, config, targets[i - 1], targets[i], {});
    if (!points) {
      course.status = no_way(targets[i]);
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

/// One MAV's course; `taken` grows by its first way.
Course make_course(const SearchState& state, const SearchConfig& config, const Searcher& mav, Points& targets,
                   std::vector<Leg>& taken) {
  Course course{.points_W = {}, .status = "nothing to visit"};
  if (!targets.empty()) {
    const auto points = first_way(state, config, mav.p_W, taken, targets);
    course.points_W = points.value_or(Points{});
    course.status = points ? "searching" : no_way(targets.front());
  }
  take_legs(mav.p_W, course.points_W, taken);
  if (!course.points_W.empty()) append_legs(state, config, targets, course);
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

std::vector<Course> make_courses(const SearchState& state, const SearchConfig& config, Targets& targets) {
  std::vector<Course> courses;
  std::vector<Leg> taken;
  for (const Searcher& mav : state.mavs) {
    courses.push_back(make_course(state, config, mav, targets[mav.mav], taken));
  }
  return courses;
}

}  // namespace comptonaut
