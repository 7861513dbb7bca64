// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/system_rows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "core/random.h"
#include "radiation/cone_row.h"
#include "radiation/toy_response.h"

namespace comptonaut {
namespace {

constexpr std::size_t kCells = 101;  // not a whole number of blocks
constexpr double kSums = 1e-6;       // relative error of sums in single precision

/// What a row stores exactly: 12 bits.
float exactly_stored(double value) {
  int exponent = 0;
  const double mantissa = std::frexp(value, &exponent);
  return static_cast<float>(std::ldexp(std::round(mantissa * 4096.0), exponent - 12));
}

std::vector<float> sparse_row(Random& random, double density) {
  std::vector<float> row(padded(kCells), 0.0F);
  for (std::size_t j = 0; j < kCells; ++j) {
    if (random.uniform() < density) row[j] = exactly_stored(random.uniform());
  }
  return row;
}

std::vector<double> some_vector(Random& random) {
  std::vector<double> v(padded(kCells), 0.0);
  for (std::size_t j = 0; j < kCells; ++j) v[j] = random.uniform(0.0, 2.0);
  return v;
}

TEST(SystemRows, ProjectLikeTheDenseMatrix) {
  Random random(3);
  for (const double density : {0.005, 0.02, 0.3, 1.0}) {
    SystemRows rows(kCells);
    std::vector<std::vector<float>> dense;
    while (dense.size() < 20) {
      const auto row = sparse_row(random, density);
      if (rows.add(row)) dense.push_back(row);
    }
    const auto x = some_vector(random);
    const auto y = some_vector(random);
    const auto t_x = forward(rows, x);
    const auto y_t = back(rows, std::span(y).first(20));
    std::vector<double> slow_y_t(padded(kCells), 0.0);
    for (std::size_t i = 0; i < dense.size(); ++i) {
      EXPECT_NEAR(t_x[i], std::inner_product(x.begin(), x.end(), dense[i].begin(), 0.0), kSums * t_x[i]) << "row " << i;
      for (std::size_t j = 0; j < kCells; ++j) slow_y_t[j] += static_cast<double>(dense[i][j]) * y[i];
    }
    for (std::size_t j = 0; j < slow_y_t.size(); ++j)
      ASSERT_NEAR(y_t[j], slow_y_t[j], kSums * slow_y_t[j]) << "cell " << j;
  }
}

TEST(SystemRows, ForwardAndBackAreAdjoint) {
  Random random(4);
  SystemRows rows(kCells);
  while (rows.rows().size() < 30) rows.add(sparse_row(random, 0.2));
  const auto x = some_vector(random);
  const auto y = some_vector(random);
  const auto t_x = forward(rows, x);
  const auto y_t = back(rows, std::span(y).first(30));
  const double forth = std::inner_product(t_x.begin(), t_x.end(), y.begin(), 0.0);
  EXPECT_NEAR(forth, std::inner_product(x.begin(), x.end(), y_t.begin(), 0.0), kSums * forth);
}

TEST(SystemRows, DivideAndProjectBackInOnePassAsInTwo) {
  Random random(7);
  SystemRows rows(kCells);
  while (rows.rows().size() < 30) rows.add(sparse_row(random, 0.1));
  auto lambda = some_vector(random);
  for (std::size_t j = 0; j < 60; ++j) lambda[j] *= 1e-200;  // rows that lambda hardly reaches, or not at all
  for (std::size_t j = 60; j < kCells; ++j) lambda[j] = 0.0;
  auto ratio = forward(rows, lambda);
  for (double& r : ratio) r = r > 0.0 ? 1.0 / r : 0.0;
  const auto two = back(rows, ratio);
  const auto one = ratio_back(rows, lambda);
  for (std::size_t j = 0; j < kCells; ++j) ASSERT_NEAR(one[j], two[j], kSums * two[j]) << "cell " << j;
}

TEST(SystemRows, StoreEachValueWithinItsStatedError) {
  Random random(6);
  for (int trial = 0; trial < 20000; ++trial) {
    std::vector<float> dense(padded(kCells), 0.0F);
    dense[3] = 1.0F;
    dense[50] = static_cast<float>(trial == 0 ? 1.0 : std::exp2(-random.uniform(0.0, 29.0)));
    SystemRows rows(kCells);
    rows.add(dense);
    const auto back_projected = back(rows, std::vector<double>{1.0});
    ASSERT_EQ(back_projected[3], 1.0);
    ASSERT_NEAR(back_projected[50] / static_cast<double>(dense[50]), 1.0, 0x1p-12) << dense[50];
  }
}

TEST(SystemRows, LeaveOutRowsOfZeros) {
  SystemRows rows(kCells);
  EXPECT_FALSE(rows.add(std::vector<float>(padded(kCells), 0.0F)));
  EXPECT_TRUE(rows.rows().empty());
}

/// Section 5, word for word, with the cut.
double slow_entry(const Eigen::Vector3d& m_W, const MlemConfig& config, const Cone& cone,
                  const Eigen::Quaterniond& q_WD) {
  const Eigen::Vector3d to_cell_W = m_W - cone.p_WS;
  const double d = to_cell_W.norm();
  const double delta = std::acos(to_cell_W.dot(cone.axis_W) / d) - std::acos(cone.cos_beta);
  const double h = std::exp(-0.5 * std::pow(delta / config.cone_sigma_rad, 2));
  if (h < config.core_cut) return 0.0;
  return toy_pair_response(q_WD.conjugate() * to_cell_W) * std::exp(-config.attenuation_per_m * d) / (d * d) * h;
}

TEST(ConeRow, IsSection5UpToItsScaleForConesOfEveryOpening) {
  const Cells cells = flat_cells({0, 30, 0, 17}, 0.5);
  const CellCentres centres(cells);
  Random random(5);
  for (int trial = 0; trial < 60; ++trial) {
    const MlemConfig config{.cone_sigma_rad = random.uniform(0.03, 0.4)};
    const Eigen::Quaterniond q_WD(Eigen::AngleAxisd(random.uniform(0, 6), random.unit_vector()));
    const double cos_beta = trial < 3 ? trial - 1.0 : random.uniform(-1.0, 1.0);
    const Cone cone{.p_WS = {random.uniform(0, 30), random.uniform(0, 17), 2.0},
                    .axis_W = random.unit_vector(),
                    .cos_beta = cos_beta};
    std::vector<float> row(padded(cells.size()), -1.0F);
    fill_cone_row(centres, toy_pair_lookup, config, cone, q_WD, row);
    double largest = 0.0;
    for (std::size_t j = 0; j < cells.size(); ++j) {
      largest = std::max(largest, slow_entry(cells.p_W(j), config, cone, q_WD));
    }
    for (std::size_t j = 0; j < cells.size(); ++j) {
      const double slow = largest > 0.0 ? slow_entry(cells.p_W(j), config, cone, q_WD) / largest : 0.0;
      ASSERT_NEAR(row[j], slow, 1e-4 * slow + 1e-7) << "cell " << j << " trial " << trial;
    }
    for (std::size_t j = cells.size(); j < row.size(); ++j) ASSERT_EQ(row[j], 0.0F) << "padding " << j;
  }
}

}  // namespace
}  // namespace comptonaut
