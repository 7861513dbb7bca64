// SPDX-License-Identifier: BSD-3-Clause
#include "search/tour_descent.h"

#include <algorithm>
#include <utility>

namespace comptonaut {
namespace {

constexpr double kGain_m = 1e-9;  ///< less is rounding, and could go round for ever
constexpr std::size_t kNear = 10;
constexpr std::size_t kStretchMax = 3;

}  // namespace

Distances::Distances(const Eigen::Vector3d& start, std::span<const Eigen::Vector3d> points) : n_(points.size() + 1) {
  std::vector<Eigen::Vector3d> places{start};
  places.insert(places.end(), points.begin(), points.end());
  for (const Eigen::Vector3d& a : places) {
    for (const Eigen::Vector3d& b : places) m_.push_back((a - b).norm());
  }
}

double length_m(const Distances& d, const Path& path) {
  double sum_m = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) sum_m += d(path[i - 1], path[i]);
  return sum_m;
}

TourDescent::TourDescent(const Distances& d)
    : d_(d), near_(d.places()), position_(d.places()), waits_(d.places(), false) {
  for (std::size_t place = 0; place < d.places(); ++place) {
    for (std::size_t other = 0; other < d.places(); ++other) {
      if (other != place) near_[place].push_back(other);
    }
    const std::size_t count = std::min(kNear, near_[place].size());
    std::partial_sort(
        near_[place].begin(), near_[place].begin() + static_cast<std::ptrdiff_t>(count), near_[place].end(),
        [&](std::size_t a, std::size_t b) { return std::pair(d(place, a), a) < std::pair(d(place, b), b); });
    near_[place].resize(count);
  }
}

void TourDescent::shorten(Path& path, std::vector<std::size_t> waiting) {
  path_ = std::move(path);
  for (std::size_t i = 0; i < path_.size(); ++i) position_[path_[i]] = i;
  for (const std::size_t place : waiting) wait(position_[place]);
  while (!waiting_.empty()) {
    const std::size_t place = waiting_.back();
    waiting_.pop_back();
    waits_[place] = false;
    while (improve(place)) {
    }
  }
  path = std::move(path_);
}

/// The first move around a place that shortens the path; false: there is none.
bool TourDescent::improve(std::size_t place) {
  const std::size_t i = position_[place];
  if (turn(i + 1, path_.size() - 1)) return true;
  const auto longest_m = [&](std::size_t at) {
    return std::max(at > 0 ? link_m(at - 1, at) : 0.0, link_m(at, at + 1));
  };
  const double here_m = longest_m(i);
  for (const std::size_t neighbour : near_[place]) {
    // Where a move links two places, it cuts a longer link of one of them.
    if (d_(place, neighbour) >= std::max(here_m, longest_m(position_[neighbour]))) continue;
    const auto [low, high] = std::minmax(position_[place], position_[neighbour]);
    if (turn(low + 1, high) || turn(low, high - 1) || move_beside(place, neighbour)) return true;
  }
  for (std::size_t last = i; last < std::min(i + kStretchMax, path_.size()); ++last) {
    if (move(i, last, path_.size() - 1)) return true;
  }
  return false;
}

/// Moves a stretch that begins or ends with the place to before or behind its neighbour.
bool TourDescent::move_beside(std::size_t place, std::size_t neighbour) {
  const std::size_t i = position_[place], k = position_[neighbour];
  for (std::size_t more = 0; more < kStretchMax; ++more) {
    for (const std::size_t after : {k, k - 1}) {
      if (i + more < path_.size() && move(i, i + more, after)) return true;
      if (i > more && move(i - more, i, after)) return true;
    }
  }
  return false;
}

/// Length of the link between places of the path; nothing follows its end.
double TourDescent::link_m(std::size_t i, std::size_t j) const {
  return j < path_.size() ? d_(path_[i], path_[j]) : 0.0;
}

/// Turns the stretch round, if that shortens the path.
bool TourDescent::turn(std::size_t first, std::size_t last) {
  if (first < 1 || first >= last) return false;
  const double before_m = link_m(first - 1, first) + link_m(last, last + 1);
  const double end_m = last + 1 < path_.size() ? link_m(first, last + 1) : 0.0;
  if (link_m(first - 1, last) + end_m > before_m - kGain_m) return false;
  std::reverse(path_.begin() + static_cast<std::ptrdiff_t>(first),
               path_.begin() + static_cast<std::ptrdiff_t>(last) + 1);
  changed(first, last);
  for (const std::size_t i : {first - 1, first, last, last + 1}) wait(i);
  return true;
}

/// Moves the stretch to behind `after`, the better way round, if that shortens the path.
bool TourDescent::move(std::size_t first, std::size_t last, std::size_t after) {
  const bool inside = after + 1 >= first && after <= last;
  if (first < 1 || after >= path_.size() || inside) return false;
  const double saved_m =
      link_m(first - 1, first) + link_m(last, last + 1) - link_m(first - 1, last + 1) + link_m(after, after + 1);
  const bool at_end = after + 1 == path_.size();
  const double forth_m = link_m(after, first) + (at_end ? 0.0 : link_m(last, after + 1));
  const double back_m = link_m(after, last) + (at_end ? 0.0 : link_m(first, after + 1));
  if (std::min(forth_m, back_m) > saved_m - kGain_m) return false;
  const auto at = [&](std::size_t i) { return path_.begin() + static_cast<std::ptrdiff_t>(i); };
  if (back_m < forth_m) std::reverse(at(first), at(last + 1));
  const std::size_t length = last - first + 1;
  if (after > last) {
    std::rotate(at(first), at(last + 1), at(after + 1));
    changed(first, after);
    for (const std::size_t i : {first - 1, first, after - length, after - length + 1, after, after + 1}) wait(i);
  } else {
    std::rotate(at(after + 1), at(first), at(last + 1));
    changed(after + 1, last);
    for (const std::size_t i : {after, after + 1, after + length, after + length + 1, last, last + 1}) wait(i);
  }
  return true;
}

void TourDescent::changed(std::size_t first, std::size_t last) {
  for (std::size_t i = first; i <= last; ++i) position_[path_[i]] = i;
}

void TourDescent::wait(std::size_t i) {
  if (i >= path_.size() || waits_[path_[i]]) return;
  waits_[path_[i]] = true;
  waiting_.push_back(path_[i]);
}

}  // namespace comptonaut
