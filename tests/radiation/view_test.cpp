// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/random.h"
#include "radiation/sensitivity.h"
#include "radiation/toy_response.h"

namespace comptonaut {
namespace {

/// Directions are looked up and responses given in single precision.
constexpr double kSinglePrecision = 2e-7;

/// Section 5, word for word.
std::vector<double> slow_sensitivity(const Cells& cells, double mu, const std::vector<Viewpoint>& viewpoints) {
  std::vector<double> s(cells.size(), 0.0);
  for (const Viewpoint& v : viewpoints) {
    for (std::size_t j = 0; j < cells.size(); ++j) {
      const Eigen::Vector3d p_DM_W = cells.p_W(j) - v.p_WD;
      const double d = p_DM_W.norm();
      const double response = toy_pair_response(v.q_WD.conjugate() * p_DM_W);
      s[j] += response * std::exp(-mu * d) / (d * d) * v.live_s;
    }
  }
  return s;
}

std::vector<Viewpoint> some_viewpoints(int n, std::uint64_t seed) {
  Random random(seed);
  std::vector<Viewpoint> viewpoints;
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector3d p_W(random.uniform(-5, 60), random.uniform(-5, 60), random.uniform(1, 4));
    const Eigen::AngleAxisd turn(random.uniform(0, 6), random.unit_vector());
    viewpoints.push_back({.p_WD = p_W, .q_WD = Eigen::Quaterniond(turn), .live_s = random.uniform(0, 0.05)});
  }
  return viewpoints;
}

std::vector<double> fast_sensitivity(const Cells& cells, double mu, const std::vector<Viewpoint>& viewpoints) {
  std::vector<double> s(padded(cells.size()), 0.0);
  const CellCentres centres(cells);
  for (const Viewpoint& viewpoint : viewpoints) add_sensitivity(centres, toy_pair_lookup, mu, viewpoint, s);
  s.resize(cells.size());
  return s;
}

TEST(ExpMinus, IsWithinItsStatedErrorEverywhere) {
  for (double x = 0.0; x < 50.0; x = x * 1.01 + 1e-4) {
    EXPECT_NEAR(exp_minus(x) / std::exp(-x), 1.0, 1e-9) << "x " << x;
  }
  EXPECT_EQ(exp_minus(0.0), 1.0);
  EXPECT_NEAR(exp_minus(699.0) / std::exp(-699.0), 1.0, 1e-9);
  EXPECT_GT(exp_minus(1e9), 0.0);
  EXPECT_LT(exp_minus(1e9), 1e-303);
}

TEST(Sensitivity, IsSection5ForAnyPlaceAndAttitude) {
  // 13 x 27 cells: neither a whole number of blocks nor of chunks.
  const Cells cells = flat_cells({0, 13, 0, 27}, 1.0);
  for (const double mu : {0.0, 0.0093, 2.0}) {
    const auto viewpoints = some_viewpoints(40, 11);
    const auto slow = slow_sensitivity(cells, mu, viewpoints);
    const auto fast = fast_sensitivity(cells, mu, viewpoints);
    for (std::size_t j = 0; j < cells.size(); ++j)
      ASSERT_NEAR(fast[j] / slow[j], 1.0, kSinglePrecision) << "cell " << j << " mu " << mu;
  }
}

TEST(Sensitivity, DoesNotDependOnTheOrderOfViewpointsBeyondRounding) {
  const Cells cells = flat_cells({0, 50, 0, 50}, 1.0);
  auto viewpoints = some_viewpoints(200, 12);
  const auto forth = fast_sensitivity(cells, 0.0093, viewpoints);
  std::reverse(viewpoints.begin(), viewpoints.end());
  const auto back = fast_sensitivity(cells, 0.0093, viewpoints);
  for (std::size_t j = 0; j < cells.size(); ++j) ASSERT_NEAR(forth[j] / back[j], 1.0, 1e-13) << "cell " << j;
}

TEST(Sensitivity, StaysFiniteWhereADetectorStandsInACell) {
  const Cells cells = flat_cells({0, 5, 0, 5}, 1.0);
  const auto s = fast_sensitivity(cells, 0.0093, {{.p_WD = cells.p_W(7), .live_s = 1.0}});
  for (const double value : s) EXPECT_TRUE(std::isfinite(value));
}

TEST(View, ACellAtTheDetectorItselfHasADirectionAndAFiniteWeight) {
  const Cells cells = flat_cells({0, 10, 0, 10}, 0.5);
  View view;
  see(CellCentres(cells), 0, kChunk, {.p_W = cells.p_W(7), .R_DW = Eigen::Matrix3d::Identity()}, view);
  EXPECT_EQ(view.x_D[7], 0.0);
  EXPECT_EQ(view.y_D[7], 0.0);
  EXPECT_EQ(view.z_D[7], kDistanceMin_m);
  EXPECT_EQ(view.d_m[7], kDistanceMin_m);
  EXPECT_DOUBLE_EQ(view.weight_per_m2[7], 1.0 / (kDistanceMin_m * kDistanceMin_m));
  EXPECT_EQ(view.z_D[8], 0.0) << "beside it";
}

}  // namespace
}  // namespace comptonaut
