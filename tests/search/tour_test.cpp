// SPDX-License-Identifier: BSD-3-Clause
#include "search/tour.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "core/random.h"

namespace comptonaut {
namespace {

std::vector<Eigen::Vector3d> some_points(std::size_t n, Random& random) {
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < n; ++i) points.emplace_back(random.uniform(0, 50), random.uniform(0, 50), 2.0);
  return points;
}

/// Shortens best_m to the length of the shortest path from `at_W` through all of `left_W`, if that is shorter: each
/// order, given up once it is as long as the best so far. `so_far_m` is the way to `at_W`.
void try_orders(const Eigen::Vector3d& at_W, std::vector<Eigen::Vector3d>& left_W, double so_far_m, double& best_m) {
  if (so_far_m >= best_m) return;
  if (left_W.empty()) best_m = so_far_m;
  for (std::size_t i = 0; i < left_W.size(); ++i) {
    std::swap(left_W[i], left_W.back());
    const Eigen::Vector3d next_W = left_W.back();
    left_W.pop_back();
    try_orders(next_W, left_W, so_far_m + (next_W - at_W).norm(), best_m);
    left_W.push_back(next_W);
    std::swap(left_W[i], left_W.back());
  }
}

double shortest_m(const Eigen::Vector3d& start, std::vector<Eigen::Vector3d> points) {
  double best_m = std::numeric_limits<double>::infinity();
  try_orders(start, points, 0.0, best_m);
  return best_m;
}

/// Of a spanning tree with the start, and a link from a place that follows the path's end to its start, each place's
/// links counted with a price; what prices that asks for two links a place cannot be more than the path [Held and Karp
/// 1970, 1971]. `known_m` is the length of some path.
double lower_bound_m(const Eigen::Vector3d& start, const std::vector<Eigen::Vector3d>& points, double known_m) {
  std::vector<Eigen::Vector3d> places{start};
  places.insert(places.end(), points.begin(), points.end());
  const std::size_t n = places.size();
  std::vector<double> price(n, 0.0);
  double best_m = 0.0, step = 1.0;
  for (int round = 0; round < 1000; ++round) {
    std::vector<double> link_m(n, std::numeric_limits<double>::infinity());
    std::vector<std::size_t> to(n, 0);
    std::vector<int> links(n, 0);
    std::vector<bool> in_tree(n, false);
    double bound_m = price[0] + *std::min_element(price.begin() + 1, price.end());
    ++links[0];
    ++links[std::min_element(price.begin() + 1, price.end()) - price.begin()];
    for (std::size_t at = 0, size = 1; size < n; ++size) {
      in_tree[at] = true;
      std::size_t next = n;
      for (std::size_t i = 0; i < n; ++i) {
        if (in_tree[i]) continue;
        const double m = (places[i] - places[at]).norm() + price[i] + price[at];
        if (m < link_m[i]) link_m[i] = m, to[i] = at;
        if (next == n || link_m[i] < link_m[next]) next = i;
      }
      bound_m += link_m[next];
      ++links[next], ++links[to[next]];
      at = next;
    }
    double squares = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      bound_m -= 2.0 * price[i];
      squares += (links[i] - 2) * (links[i] - 2);
    }
    best_m = std::max(best_m, bound_m);
    if (squares == 0.0) break;
    step *= 0.995;
    for (std::size_t i = 0; i < n; ++i) price[i] += step * (known_m - bound_m) / squares * (links[i] - 2);
  }
  return best_m;
}

bool is_permutation_of_all(std::vector<std::size_t> order, std::size_t n) {
  std::sort(order.begin(), order.end());
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (order[i] != i) return false;
  }
  return order.size() == n;
}

TEST(OpenTour, IsTheShortestOfAllUpToTwelvePoints) {
  ASSERT_EQ(kExactTour, 12u);
  Random random(5);
  for (std::size_t n = 0; n <= kExactTour; ++n) {
    for (int trial = 0; trial < (n < 9 ? 10 : 3); ++trial) {
      const auto points = some_points(n, random);
      const Eigen::Vector3d start(random.uniform(0, 50), random.uniform(0, 50), 2.0);
      const auto order = open_tour(start, points);
      ASSERT_TRUE(is_permutation_of_all(order, n)) << n << " points";
      EXPECT_NEAR(tour_length_m(start, points, order), shortest_m(start, points), 1e-9) << n << " points";
    }
  }
}

/// Beyond the exact ones: on a ring, seen from one of its points, the shortest way is round the ring.
TEST(OpenTour, GoesRoundARingInOrder) {
  std::vector<Eigen::Vector3d> ring;
  for (int i = 1; i < 40; ++i) ring.emplace_back(10 * std::cos(0.15 * i), 10 * std::sin(0.15 * i), 2.0);
  Random random(6);
  for (std::size_t i = ring.size() - 1; i > 0; --i) std::swap(ring[i], ring[random() % (i + 1)]);
  const auto order = open_tour({10, 0, 2}, ring);
  EXPECT_NEAR(tour_length_m({10, 0, 2}, ring, order), 39 * 2 * 10 * std::sin(0.075), 1e-9);
}

TEST(OpenTour, VisitsAllPointsAndNoStretchTurnedRoundWouldShortenIt) {
  Random random(7);
  for (const std::size_t n : {13u, 30u, 90u}) {
    const auto points = some_points(n, random);
    const Eigen::Vector3d start(0, 0, 2);
    auto order = open_tour(start, points);
    ASSERT_TRUE(is_permutation_of_all(order, n)) << n << " points";
    const double length_m = tour_length_m(start, points, order);
    EXPECT_LT(length_m, 0.7124 * std::sqrt(static_cast<double>(n) * 2500.0) * 1.35) << n << " points";
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = i + 1; j < n; ++j) {
        auto turned = order;
        std::reverse(turned.begin() + static_cast<std::ptrdiff_t>(i),
                     turned.begin() + static_cast<std::ptrdiff_t>(j) + 1);
        ASSERT_GE(tour_length_m(start, points, turned), length_m - 1e-6) << n << " points, " << i << ".." << j;
      }
    }
  }
}

TEST(OpenTour, IsAtMostTwoPercentLongerThanAnyOtherUpToTwoHundredPoints) {
  Random random(8);
  for (const std::size_t n : {5u, 8u, 13u, 20u, 40u, 80u, 140u, 200u}) {
    for (int trial = 0; trial < 5; ++trial) {
      const auto points = some_points(n, random);
      const Eigen::Vector3d start(random.uniform(0, 50), random.uniform(0, 50), 2.0);
      const double length_m = tour_length_m(start, points, open_tour(start, points));
      const double bound_m = lower_bound_m(start, points, length_m);
      EXPECT_LE(bound_m, length_m + 1e-9) << n << " points: the bound itself is wrong";
      EXPECT_LE(length_m, 1.02 * bound_m) << n << " points, trial " << trial;
    }
  }
}

TEST(OpenTour, TakesPointsThatCoincide) {
  const std::vector<Eigen::Vector3d> points(20, Eigen::Vector3d(3, 4, 2));
  EXPECT_TRUE(is_permutation_of_all(open_tour({0, 0, 2}, points), 20));
}

}  // namespace
}  // namespace comptonaut
