// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/system_rows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "core/random.h"
#include "radiation/sparse_row.h"

namespace comptonaut {
namespace {

constexpr std::size_t kCells = 101;  // not a whole number of blocks
constexpr std::size_t kRows = 70;    // not a whole number of tiles
constexpr double kSums = 1e-6;       // relative error of sums in single precision

/// What a row stores exactly: 12 bits.
float exactly_stored(double value) {
  int exponent = 0;
  const double mantissa = std::frexp(value, &exponent);
  return static_cast<float>(std::ldexp(std::round(mantissa * 4096.0), exponent - 12));
}

std::vector<float> some_row(Random& random, double density) {
  std::vector<float> row(padded(kCells), 0.0F);
  for (std::size_t j = 0; j < kCells; ++j) {
    if (random.uniform() < density) row[j] = exactly_stored(random.uniform());
  }
  with_largest_one(row);
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
    std::vector<std::vector<float>> all;
    while (all.size() < kRows) {
      const auto row = some_row(random, density);
      if (rows.add(sparse(row))) all.push_back(row);
    }
    const auto x = some_vector(random);
    const auto y = some_vector(random);
    const auto t_x = forward(rows, x);
    const auto y_t = back(rows, std::span(y).first(kRows));
    std::vector<double> slow_y_t(padded(kCells), 0.0);
    for (std::size_t i = 0; i < all.size(); ++i) {
      EXPECT_NEAR(t_x[i], std::inner_product(x.begin(), x.end(), all[i].begin(), 0.0), kSums * t_x[i]) << "row " << i;
      for (std::size_t j = 0; j < kCells; ++j) slow_y_t[j] += static_cast<double>(all[i][j]) * y[i];
    }
    for (std::size_t j = 0; j < slow_y_t.size(); ++j)
      ASSERT_NEAR(y_t[j], slow_y_t[j], kSums * slow_y_t[j]) << "cell " << j;
  }
}

TEST(SystemRows, ForwardAndBackAreAdjoint) {
  Random random(4);
  SystemRows rows(kCells);
  while (rows.size() < 30) rows.add(sparse(some_row(random, 0.2)));
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
  while (rows.size() < 30) rows.add(sparse(some_row(random, 0.1)));
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
    rows.add(sparse(dense));
    const auto back_projected = back(rows, std::vector<double>{1.0});
    ASSERT_EQ(back_projected[3], 1.0);
    ASSERT_NEAR(back_projected[50] / static_cast<double>(dense[50]), 1.0, 0x1p-12) << dense[50];
  }
}

TEST(SystemRows, LeaveOutRowsOfZeros) {
  SystemRows rows(kCells);
  EXPECT_FALSE(rows.add(SparseRow{}));
  EXPECT_EQ(rows.size(), 0U);
}

TEST(SystemRows, LeaveOutWhatIsBelowTheRowsCut) {
  std::vector<float> row(padded(kCells), 0.0F);
  row[2] = 4.0F;
  row[30] = 0.5F;
  row[31] = 0.3F;
  SystemRows rows(kCells);
  rows.add(sparse(row), 0.1);
  const auto stored = back(rows, std::vector<double>{1.0});
  EXPECT_EQ(stored[2], 1.0);
  EXPECT_EQ(stored[30], 0.125);
  EXPECT_EQ(stored[31], 0.0);
}

}  // namespace
}  // namespace comptonaut
