// SPDX-License-Identifier: BSD-3-Clause
#include "search/tour.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "core/random.h"
#include "search/tour_descent.h"

namespace comptonaut {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kKicksPerPoint = 10;
constexpr std::size_t kKicksMax = 2010;  ///< long tours must be quick, too
constexpr std::size_t kKickReach = 50;   ///< places that a kick reaches over

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

/// Changes places of two random stretches, one behind the other: three links at once, which no move of the descent
/// undoes [Martin, Otto and Felten 1991]. Returns the places at the links.
std::vector<std::size_t> kick(Path& path, Random& random) {
  const std::size_t reach = std::min(kKickReach, path.size() - 1);
  const std::size_t from = 1 + random() % (path.size() - reach);
  std::array<std::size_t, 3> cut = {};
  for (std::size_t& i : cut) i = from + random() % (reach + 1);
  std::sort(cut.begin(), cut.end());
  const auto at = [&](std::size_t i) { return path.begin() + static_cast<std::ptrdiff_t>(i); };
  std::rotate(at(cut[0]), at(cut[1]), at(cut[2]));
  std::vector<std::size_t> places;
  for (const std::size_t i : {cut[0], cut[0] + cut[2] - cut[1], cut[2]}) {
    places.push_back(path[i - 1]);
    if (i < path.size()) places.push_back(path[i]);
  }
  return places;
}

/// Descent from the nearest neighbours' path, then kicks, each kept if what the descent makes of it is shorter.
Path descended(const Distances& d) {
  TourDescent descent(d);
  Path best = nearest_neighbour(d);
  descent.shorten(best, best);
  double best_m = length_m(d, best);
  Random random(1);
  const std::size_t kicks = std::min(kKicksMax, kKicksPerPoint * d.places());
  for (std::size_t i = 0; i < kicks; ++i) {
    Path path = best;
    const std::vector<std::size_t> places = kick(path, random);
    descent.shorten(path, places);
    const double m = length_m(d, path);
    if (m < best_m) {
      best_m = m;
      best = std::move(path);
    }
  }
  return best;
}

}  // namespace

std::vector<std::size_t> open_tour(const Eigen::Vector3d& start, std::span<const Eigen::Vector3d> points) {
  if (points.empty()) return {};
  const Distances d(start, points);
  const Path path = points.size() <= kExactTour ? held_karp(d) : descended(d);
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
