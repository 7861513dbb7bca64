// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/metrics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/random.h"
#include "radiation/assignment.h"

namespace comptonaut {
namespace {

using Points = std::vector<PointSource>;

PointSource at(double x_m, double y_m, double activity_Bq = 1e9) { return {{x_m, y_m, 0}, activity_Bq}; }

TEST(AssignRows, CostsNoMoreThanTheBestOfAllPermutations) {
  Random random(1);
  for (int round = 0; round < 300; ++round) {
    const int rows = 1 + round % 4, columns = rows + round % 3;
    Eigen::MatrixXd cost(rows, columns);
    for (double& c : cost.reshaped()) c = round % 2 ? random.uniform(-5, 5) : std::floor(random.uniform(0, 4));
    const std::vector<int> column_of = assign_rows(cost);
    double total = 0.0, best = std::numeric_limits<double>::infinity();
    for (int i = 0; i < rows; ++i) total += cost(i, column_of[i]);
    std::vector<int> order(columns);
    std::iota(order.begin(), order.end(), 0);
    do {
      double sum = 0.0;
      for (int i = 0; i < rows; ++i) sum += cost(i, order[i]);
      best = std::min(best, sum);
    } while (std::next_permutation(order.begin(), order.end()));
    EXPECT_NEAR(total, best, 1e-12) << "round " << round << "\n" << cost;
    std::vector<int> used = column_of;
    std::sort(used.begin(), used.end());
    EXPECT_EQ(std::adjacent_find(used.begin(), used.end()), used.end()) << "a column twice, round " << round;
  }
}

TEST(AssignRows, RefusesTooFewColumns) {
  EXPECT_THROW((void)assign_rows(Eigen::MatrixXd(2, 1)), std::invalid_argument);
}

TEST(Localise, TwoTrueSourcesShareTheNearestEstimateButNotTheAssignedOne) {
  const Localisation result = localise(Points{at(0, 0), at(1, 0)}, Points{at(0, 0), at(40, 30)}, 70.0);
  EXPECT_NEAR(result.rmse_nearest_m, std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(result.rmse_m, std::sqrt((39.0 * 39.0 + 30.0 * 30.0) / 2), 1e-12);
  EXPECT_EQ(result.found_2m, 1);
  EXPECT_EQ(result.found_half_m, 1);
  EXPECT_EQ(result.false_reports, 1);
  EXPECT_EQ(result.found_by, (std::vector<int>{0, -1}));
}

TEST(Localise, NoEstimateStandsForASourceOfAnotherNuclide) {
  const Points truth = {{.p_W = {0, 0, 0}, .activity_Bq = 1e9, .nuclide = "Cs-137"},
                        {.p_W = {9, 0, 0}, .activity_Bq = 1e9, .nuclide = "Co-60"}};
  const Points estimates = {{.p_W = {0, 0, 0}, .activity_Bq = 1e9, .nuclide = "Co-60"},
                            {.p_W = {9.5, 0, 0}, .activity_Bq = 1e9, .nuclide = "Co-60"}};
  const Localisation result = localise(truth, estimates, 70.0);
  EXPECT_EQ(result.found_by, (std::vector<int>{-1, 1}));
  EXPECT_EQ(result.false_reports, 1);
  EXPECT_EQ(result.nearest_m, (std::vector<double>{70.0, 0.5}));
  EXPECT_NEAR(result.rmse_m, std::sqrt((70.0 * 70.0 + 0.25) / 2), 1e-9);
}

TEST(Localise, AFarEstimateDoesNotTakeAFoundSourceAway) {
  const Localisation result = localise(Points{at(0, 0), at(10, 0)}, Points{at(0.1, 0), at(-50, 0)}, 70.0);
  EXPECT_EQ(result.found_2m, 1);
  EXPECT_EQ(result.found_by, (std::vector<int>{0, -1}));
}

TEST(Localise, FindsAsManyAsCanBeMatched) {
  // The first source could take either estimate, the second only the one that is nearer to the first.
  const Localisation result = localise(Points{at(0, 0), at(2.5, 0)}, Points{at(0.9, 0), at(-1.5, 0)}, 70.0);
  EXPECT_EQ(result.found_2m, 2);
  EXPECT_EQ(result.found_by, (std::vector<int>{1, 0}));
  EXPECT_EQ(result.false_reports, 0);
}

TEST(Localise, WithoutEstimatesEachSourceIsTheDiagonalAway) {
  const Localisation result = localise(Points{at(1, 1), at(2, 2)}, {}, 70.5);
  EXPECT_DOUBLE_EQ(result.rmse_nearest_m, 70.5);
  EXPECT_DOUBLE_EQ(result.rmse_m, 70.5);
  EXPECT_EQ(result.found_2m + result.reported + result.false_reports, 0);
  EXPECT_TRUE(std::isnan(result.activity_error_rel));
}

TEST(Localise, WithoutTrueSourcesEveryEstimateIsFalse) {
  const Localisation result = localise({}, Points{at(1, 1), at(2, 2)}, 70.5);
  EXPECT_EQ(result.false_reports, 2);
  EXPECT_EQ(result.rmse_m, 0.0);
}

TEST(Localise, ActivityErrorIsTheMedianOverFoundSources) {
  const Points truth{at(0, 0, 100), at(10, 0, 200), at(20, 0, 400), at(40, 0, 1)};
  const Points estimates{at(20, 0, 500), at(0, 1, 90), at(10, 1, 400)};
  EXPECT_NEAR(localise(truth, estimates, 70).activity_error_rel, 0.25, 1e-12);
}

TEST(Localise, NeverRanksTheAssignedErrorBelowTheNearest) {
  Random random(2);
  for (int round = 0; round < 200; ++round) {
    Points truth(1 + round % 6), estimates(round % 9);
    for (Points* points : {&truth, &estimates}) {
      for (PointSource& p : *points) p = at(random.uniform(0, 20), random.uniform(0, 20));
    }
    const Localisation result = localise(truth, estimates, 28.3);
    EXPECT_LE(result.rmse_nearest_m, result.rmse_m + 1e-12) << "round " << round;
    EXPECT_LE(result.found_half_m, result.found_2m) << "round " << round;
    EXPECT_EQ(result.found_2m + result.false_reports, result.reported) << "round " << round;
  }
}

TEST(ComparedEstimates, AreTheStrongestOfMlemAndAllOfJoint) {
  SourceReport report{.estimator = "mlem", .sources = std::vector<SourceEstimate>(4)};
  for (int i = 0; i < 4; ++i) report.sources[i].activity_Bq = 40 - i;
  EXPECT_EQ(compared_estimates(report, 3).size(), 3u);
  EXPECT_EQ(compared_estimates(report, 3).back().activity_Bq, 38);
  EXPECT_EQ(compared_estimates(report, 9).size(), 4u);
  report.estimator = "joint";
  EXPECT_EQ(compared_estimates(report, 3).size(), 4u);
}

}  // namespace
}  // namespace comptonaut
