// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/map_sources.h"

#include <gtest/gtest.h>

#include <numeric>

#include "core/random.h"
#include "radiation/local_maxima.h"

namespace comptonaut {
namespace {

const Cells& field() {
  static const Cells cells = flat_cells({0, 12, 0, 9}, 0.5);
  return cells;
}

std::size_t at(double x_m, double y_m) { return *field().find({int(x_m * 2), int(y_m * 2), -1}); }

TEST(LocalMaxima, AreTheCellsThatNoNeighbourExceeds) {
  Random random(31);
  std::vector<double> value(field().size());
  for (double& v : value) v = random.uniform();
  std::vector<std::uint32_t> slow;
  for (std::uint32_t j = 0; j < value.size(); ++j) {
    bool maximum = true;
    for (const auto k : field().neighbours(j)) maximum = maximum && value[k] < value[j];
    if (maximum) slow.push_back(j);
  }
  std::sort(slow.begin(), slow.end(), [&](auto a, auto b) { return value[a] > value[b]; });
  EXPECT_EQ(local_maxima(field(), value), slow);
}

TEST(LocalMaxima, APlateauIsOneMaximumAndAShelfIsNone) {
  std::vector<double> value(field().size(), 0.0);
  for (double x = 2.0; x < 5.0; x += 0.5) value[at(x, 3.0)] = value[at(x, 3.5)] = 4.0;  // plateau
  for (double x = 7.0; x < 9.0; x += 0.5) value[at(x, 3.0)] = 2.0;                      // shelf, with a step at its end
  value[at(9.0, 3.0)] = 3.0;
  EXPECT_EQ(local_maxima(field(), value),
            (std::vector<std::uint32_t>{std::uint32_t(at(2.0, 3.0)), std::uint32_t(at(9.0, 3.0))}));
}

TEST(LocalMaxima, AMapOfZerosHasNone) {
  EXPECT_TRUE(local_maxima(field(), std::vector<double>(field().size(), 0.0)).empty());
}

TEST(SourcesOfMap, HighestFirstAndEachCellCountsForItsNearestMaximum) {
  std::vector<double> lambda(field().size(), 0.0);
  lambda[at(3.0, 4.0)] = 100.0;
  lambda[at(3.5, 4.0)] = 20.0;  // beside the first
  lambda[at(5.5, 4.0)] = 50.0;
  lambda[at(5.0, 4.0)] = 7.0;  // 0.5 m from the second, 2 m from the first
  lambda[at(10.0, 4.0)] = 30.0;
  lambda[at(10.0, 5.5)] = 0.0;
  const auto sources = sources_of_map(field(), lambda, local_maxima(field(), lambda), "Cs-137", 2.0);
  ASSERT_EQ(sources.size(), 3u);
  EXPECT_EQ(sources[0].p_W, field().p_W(at(3.0, 4.0)));
  EXPECT_EQ(sources[0].activity_Bq, 120.0);
  EXPECT_EQ(sources[1].activity_Bq, 57.0);
  EXPECT_EQ(sources[2].activity_Bq, 30.0);
  EXPECT_EQ(sources[0].nuclide, "Cs-137");
  EXPECT_TRUE(std::isnan(sources[0].significance));
}

TEST(SourcesOfMap, AgreesWithTheSlowSumOnARoughMap) {
  Random random(32);
  std::vector<double> lambda(field().size());
  for (double& v : lambda) v = random.exponential();
  const auto maxima = local_maxima(field(), lambda);
  const auto sources = sources_of_map(field(), lambda, maxima, "Cs-137", 1.3);
  ASSERT_EQ(sources.size(), std::min(maxima.size(), kMaxSources));
  std::vector<double> slow(maxima.size(), 0.0);
  for (std::size_t j = 0; j < field().size(); ++j) {
    std::size_t best = maxima.size();
    double best_m = 1.3;
    for (std::size_t i = 0; i < maxima.size(); ++i) {
      const double d_m = (field().p_W(j) - field().p_W(maxima[i])).norm();
      if (d_m < best_m || (d_m == best_m && best == maxima.size())) best = i, best_m = d_m;
    }
    if (best < maxima.size()) slow[best] += lambda[j];
  }
  for (std::size_t i = 0; i < sources.size(); ++i)
    EXPECT_NEAR(sources[i].activity_Bq, slow[i], 1e-12) << "source " << i;
}

}  // namespace
}  // namespace comptonaut
