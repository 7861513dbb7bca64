// SPDX-License-Identifier: BSD-3-Clause
#include "search/tour.h"

#include <algorithm>
#include <limits>

namespace comptonaut {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kGain_m = 1e-9;  ///< less is rounding, and could go round for ever

/// Distances between places: place 0 is the start, place i + 1 is point i.
class Distances {
 public:
  Distances(const Eigen::Vector3d& start, std::span<const Eigen::Vector3d> points) : n_(points.size() + 1) {
    std::vector<Eigen::Vector3d> places{start};
    places.insert(places.end(), points.begin(), points.end());
    for (const Eigen::Vector3d& a : places) {
      for (const Eigen::Vector3d& b : places) m_.push_back((a - b).norm());
    }
  }
  [[nodiscard]] std::size_t places() const { return n_; }
  [[nodiscard]] double operator()(std::size_t a, std::size_t b) const { return m_[a * n_ + b]; }

 private:
  std::size_t n_;
  std::vector<double> m_;
};

/// A path of places that begins at the start, place 0.
using Path = std::vector<std::size_t>;

/// Shortest path through each set of points that ends at each of its points, by dynamic programming over sets.
Path held_karp(const Distances& d) {
  const std::size_t n = d.places() - 1;
  const std::size_t sets = std::size_t{1} << n;
  struct Best {
    double m = kInfinity;
    std::size_t before = 0;
  };
  std::vector<Best> best(sets * n);
  for (std::size_t i = 0; i < n; ++i) best[(std::size_t{1} << i) * n + i] = {.m = d(0, i + 1), .before = n};
  for (std::size_t set = 1; set < sets; ++set) {
    for (std::size_t last = 0; last < n; ++last) {
      const double so_far_m = best[set * n + last].m;
      if (so_far_m == kInfinity) continue;
      for (std::size_t next = 0; next < n; ++next) {
        if ((set >> next & 1) != 0) continue;
        Best& longer = best[(set | std::size_t{1} << next) * n + next];
        const double m = so_far_m + d(last + 1, next + 1);
        if (m < longer.m) longer = {.m = m, .before = last};
      }
    }
  }
  std::size_t set = sets - 1, last = 0;
  for (std::size_t i = 1; i < n; ++i) {
    if (best[set * n + i].m < best[set * n + last].m) last = i;
  }
  Path path;
  while (last != n) {
    path.push_back(last + 1);
    const std::size_t before = best[set * n + last].before;
    set ^= std::size_t{1} << last;
    last = before;
  }
  path.push_back(0);
  std::reverse(path.begin(), path.end());
  return path;
}

Path nearest_neighbour(const Distances& d) {
  Path path{0};
  std::vector<bool> taken(d.places(), false);
  while (path.size() < d.places()) {
    std::size_t next = 0;
    for (std::size_t i = 1; i < d.places(); ++i) {
      if (!taken[i] && (next == 0 || d(path.back(), i) < d(path.back(), next))) next = i;
    }
    taken[next] = true;
    path.push_back(next);
  }
  return path;
}

/// Turns round any stretch [i, j] where that shortens the path. The end is free: nothing follows the last place.
bool two_opt(const Distances& d, Path& path) {
  bool better = false;
  const std::size_t n = path.size();
  for (std::size_t i = 1; i + 1 < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      const double after_m = j + 1 < n ? d(path[i], path[j + 1]) - d(path[j], path[j + 1]) : 0.0;
      if (d(path[i - 1], path[j]) - d(path[i - 1], path[i]) + after_m > -kGain_m) continue;
      std::reverse(path.begin() + static_cast<std::ptrdiff_t>(i), path.begin() + static_cast<std::ptrdiff_t>(j) + 1);
      better = true;
    }
  }
  return better;
}

/// What it costs to have places a .. b between places i and i + 1 of the path, or after its end.
double detour_m(const Distances& d, const Path& path, std::size_t i, std::size_t a, std::size_t b) {
  if (i + 1 == path.size()) return d(path[i], a);
  return d(path[i], a) + d(b, path[i + 1]) - d(path[i], path[i + 1]);
}

/// Where a stretch costs the path least.
struct Place {
  std::size_t after = 0;
  bool turned = false;
  double detour_m = kInfinity;
};

Place best_place(const Distances& d, const Path& path, const Path& stretch) {
  Place best;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const double forth_m = detour_m(d, path, i, stretch.front(), stretch.back());
    const double back_m = detour_m(d, path, i, stretch.back(), stretch.front());
    if (forth_m < best.detour_m) best = {.after = i, .turned = false, .detour_m = forth_m};
    if (back_m < best.detour_m) best = {.after = i, .turned = true, .detour_m = back_m};
  }
  return best;
}

/// Moves the `length` places from i on to where they cost least, if that is elsewhere.
bool move_stretch(const Distances& d, Path& path, std::size_t i, std::size_t length) {
  const auto begin = path.begin() + static_cast<std::ptrdiff_t>(i);
  const auto end = begin + static_cast<std::ptrdiff_t>(length);
  Path stretch(begin, end);
  Path rest(path.begin(), begin);
  rest.insert(rest.end(), end, path.end());
  const Place best = best_place(d, rest, stretch);
  if (best.detour_m > detour_m(d, rest, i - 1, stretch.front(), stretch.back()) - kGain_m) return false;
  if (best.turned) std::reverse(stretch.begin(), stretch.end());
  rest.insert(rest.begin() + static_cast<std::ptrdiff_t>(best.after) + 1, stretch.begin(), stretch.end());
  path = std::move(rest);
  return true;
}

bool or_opt(const Distances& d, Path& path) {
  bool better = false;
  for (std::size_t length = 1; length <= 3; ++length) {
    for (std::size_t i = 1; i + length <= path.size(); ++i) better = move_stretch(d, path, i, length) || better;
  }
  return better;
}

}  // namespace

std::vector<std::size_t> open_tour(const Eigen::Vector3d& start, std::span<const Eigen::Vector3d> points) {
  if (points.empty()) return {};
  const Distances d(start, points);
  Path path = points.size() <= kExactTour ? held_karp(d) : nearest_neighbour(d);
  while (points.size() > kExactTour && (two_opt(d, path) || or_opt(d, path))) {
  }
  std::vector<std::size_t> order;
  for (std::size_t i = 1; i < path.size(); ++i) order.push_back(path[i] - 1);
  return order;
}

double tour_length_m(const Eigen::Vector3d& start, std::span<const Eigen::Vector3d> points,
                     std::span<const std::size_t> order) {
  double length_m = 0.0;
  Eigen::Vector3d at = start;
  for (const std::size_t i : order) {
    length_m += (points[i] - at).norm();
    at = points[i];
  }
  return length_m;
}

}  // namespace comptonaut
