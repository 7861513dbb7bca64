// SPDX-License-Identifier: BSD-3-Clause
#include "search/share_by_time.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "core/random.h"

namespace comptonaut {
namespace {

using Points = std::vector<Eigen::Vector3d>;
constexpr MotionLimits kLimits{.speed_max_m_s = 8.0, .acceleration_max_m_s2 = 4.0};

Points some_points(std::size_t n, double edge_m, Random& random) {
  Points points;
  for (std::size_t i = 0; i < n; ++i) points.emplace_back(random.uniform(0, edge_m), random.uniform(0, edge_m), 2.0);
  return points;
}

double last_s(const Points& starts, const Points& points, const std::vector<std::vector<std::size_t>>& shares) {
  double last = 0.0;
  for (std::size_t m = 0; m < starts.size(); ++m)
    last = std::max(last, flight_time_s(starts[m], points, shares[m], kLimits));
  return last;
}

/// The least time in which one MAV can visit a set of points, in any order.
double quickest_s(const Eigen::Vector3d& start, const Points& points, std::vector<std::size_t> order) {
  double best = std::numeric_limits<double>::infinity();
  do {
    best = std::min(best, flight_time_s(start, points, order, kLimits));
  } while (std::next_permutation(order.begin(), order.end()));
  return best;
}

/// Over all ways to share.
double least_s(const Points& starts, const Points& points) {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t set = 0; set < std::size_t{1} << points.size(); ++set) {
    std::vector<std::size_t> first, second;
    for (std::size_t p = 0; p < points.size(); ++p) (set >> p & 1 ? first : second).push_back(p);
    best = std::min(best, std::max(quickest_s(starts[0], points, first), quickest_s(starts[1], points, second)));
  }
  return best;
}

TEST(ShareByTime, IsNearTheBestOfAllWaysToShare) {
  Random random(1);
  double sum = 0.0, worst = 0.0;
  constexpr int kTrials = 30;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Points starts = some_points(2, 10, random), points = some_points(6, 50, random);
    const double ratio = last_s(starts, points, share_by_time(starts, points, kLimits)) / least_s(starts, points);
    EXPECT_GE(ratio, 1.0 - 1e-9) << "trial " << trial;
    sum += ratio;
    worst = std::max(worst, ratio);
  }
  EXPECT_LT(sum / kTrials, 1.02);
  EXPECT_LT(worst, 1.12);
}

TEST(ShareByTime, BalancesTimeNotNumber) {
  Points points;
  for (int i = 0; i < 20; ++i) points.emplace_back(i % 5, i / 5, 2);  // twenty close together, two far apart
  points.emplace_back(80, 0, 2);
  points.emplace_back(0, 80, 2);
  const Points starts{{0, 0, 2}, {2, 0, 2}, {4, 0, 2}};
  const auto shares = share_by_time(starts, points, kLimits);
  std::vector<std::size_t> sizes;
  for (const auto& share : shares) sizes.push_back(share.size());
  std::ranges::sort(sizes);
  EXPECT_LE(sizes[1], 5u);
  EXPECT_GE(sizes[2], 12u);
}

TEST(ShareByTime, VisitsEachPointOnceAndNobodyIsMuchLongerUnderWay) {
  Random random(2);
  for (const std::size_t n : {0u, 1u, 2u, 17u, 60u, 200u}) {
    const Points starts = some_points(5, 8, random), points = some_points(n, 100, random);
    const auto shares = share_by_time(starts, points, kLimits);
    std::vector<int> visits(n, 0);
    for (const auto& share : shares) {
      for (const std::size_t p : share) ++visits[p];
    }
    EXPECT_TRUE(std::ranges::all_of(visits, [](int count) { return count == 1; })) << n << " points";
    if (n < 17) continue;
    double shortest = 1e9;
    for (std::size_t m = 0; m < 5; ++m)
      shortest = std::min(shortest, flight_time_s(starts[m], points, shares[m], kLimits));
    EXPECT_LT(last_s(starts, points, shares), 1.4 * shortest) << n << " points";
  }
}

TEST(ShareByTime, WithoutMavsThereAreNoShares) {
  EXPECT_TRUE(share_by_time({}, Points{{1, 2, 3}}, kLimits).empty());
  EXPECT_EQ(share_by_time(Points{{1, 2, 3}}, {}, kLimits).size(), 1u);
}

}  // namespace
}  // namespace comptonaut
