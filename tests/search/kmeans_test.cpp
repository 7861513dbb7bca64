// SPDX-License-Identifier: BSD-3-Clause
#include "search/kmeans.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "core/random.h"

namespace comptonaut {
namespace {

using Points = std::vector<Eigen::Vector2d>;

Points some_points(std::size_t n, Random& random) {
  Points points;
  for (std::size_t i = 0; i < n; ++i) points.emplace_back(random.uniform(0, 50), random.uniform(0, 50));
  return points;
}

TEST(Kmeans, LeavesEveryPointWithItsNearestCentreAndEveryCentreAtItsPointsMean) {
  Random random(1);
  for (int trial = 0; trial < 50; ++trial) {
    const Points points = some_points(10 + trial, random);
    const Clusters clusters = kmeans(points, some_points(4, random), 1000);
    Points sums(4, Eigen::Vector2d::Zero());
    std::vector<double> sizes(4, 0.0);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const std::size_t c = clusters.cluster_of[i];
      sums[c] += points[i];
      sizes[c] += 1.0;
      for (const Eigen::Vector2d& other : clusters.centres) {
        EXPECT_LE((points[i] - clusters.centres[c]).norm(), (points[i] - other).norm() + 1e-12) << "trial " << trial;
      }
    }
    for (std::size_t c = 0; c < 4; ++c) {
      ASSERT_GT(sizes[c], 0.0) << "trial " << trial;
      EXPECT_LT((sums[c] / sizes[c] - clusters.centres[c]).norm(), 1e-9) << "trial " << trial;
    }
  }
}

TEST(Kmeans, LeavesNoClusterEmptyWhileThereArePointsEnough) {
  Random random(2);
  for (std::size_t n = 3; n < 20; ++n) {
    const Points points = some_points(n, random);
    const Points same_seeds(3, Eigen::Vector2d(0, 0));  // a team that starts on one spot
    const Clusters clusters = kmeans(points, same_seeds);
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_GT(std::count(clusters.cluster_of.begin(), clusters.cluster_of.end(), c), 0) << n << " points";
    }
  }
}

TEST(Kmeans, TakesFewerPointsThanClustersAndNone) {
  const Points one{{1, 2}};
  EXPECT_EQ(kmeans(one, Points(3, Eigen::Vector2d(0, 0))).cluster_of.size(), 1u);
  EXPECT_TRUE(kmeans({}, Points(3, Eigen::Vector2d(0, 0))).cluster_of.empty());
  EXPECT_TRUE(kmeans({}, {}).centres.empty());
}

TEST(SpreadSeeds, AreDistinctPointsFartherApartThanTheRestIsFromThem) {
  Random random(3);
  const Points points = some_points(300, random);
  const Points seeds = spread_seeds(points, 20);
  ASSERT_EQ(seeds.size(), 20u);
  double closest_m = 1e9, farthest_m = 0.0;
  for (std::size_t a = 0; a < seeds.size(); ++a) {
    EXPECT_NE(std::find(points.begin(), points.end(), seeds[a]), points.end());
    for (std::size_t b = 0; b < a; ++b) closest_m = std::min(closest_m, (seeds[a] - seeds[b]).norm());
  }
  for (const Eigen::Vector2d& p : points) {
    double nearest_m = 1e9;
    for (const Eigen::Vector2d& seed : seeds) nearest_m = std::min(nearest_m, (seed - p).norm());
    farthest_m = std::max(farthest_m, nearest_m);
  }
  EXPECT_GE(closest_m, farthest_m);
  EXPECT_EQ(spread_seeds(points, 500).size(), 300u);
  EXPECT_TRUE(spread_seeds(points, 0).empty());
}

}  // namespace
}  // namespace comptonaut
