// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/mlem.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "core/random.h"
#include "radiation/sparse_row.h"

namespace comptonaut {
namespace {

struct Problem {
  std::size_t cells;
  std::vector<std::vector<float>> dense;
  SystemRows rows;
  std::vector<double> s;

  Problem(std::size_t cells_, std::size_t n_rows, double density, std::uint64_t seed) : cells(cells_), rows(cells_) {
    Random random(seed);
    while (dense.size() < n_rows) {
      std::vector<float> row(padded(cells), 0.0F);
      for (std::size_t j = 0; j < cells; ++j) {
        if (random.uniform() < density)
          row[j] = static_cast<float>(std::ceil(random.uniform(0, 1024)) / 1024.0);  // stored exactly
      }
      with_largest_one(row);
      if (rows.add(sparse(row))) dense.push_back(row);
    }
    s.assign(padded(cells), 0.0);
    for (std::size_t j = 0; j < cells; ++j) s[j] = random.uniform(0.5, 1.5);
  }

  [[nodiscard]] double log_likelihood(const std::vector<double>& lambda) const {
    double sum = -std::inner_product(s.begin(), s.end(), lambda.begin(), 0.0);
    for (const double expected : forward(rows, lambda)) sum += std::log(expected);
    return sum;
  }
};

/// Section 5.1, word for word.
std::vector<double> slow_mlem(const Problem& p, int iterations) {
  std::vector<double> lambda(p.cells, 1.0);
  for (int n = 0; n < iterations; ++n) {
    std::vector<double> update(p.cells, 0.0);
    for (const auto& t : p.dense) {
      double forward_t = 0.0;
      for (std::size_t k = 0; k < p.cells; ++k) forward_t += static_cast<double>(t[k]) * lambda[k];
      for (std::size_t j = 0; j < p.cells; ++j) update[j] += static_cast<double>(t[j]) / forward_t;
    }
    for (std::size_t j = 0; j < p.cells; ++j) lambda[j] *= update[j] / p.s[j];
  }
  return lambda;
}

constexpr double kSums = 5e-6;  // relative error of single precision's sums, after ten steps

TEST(Mlem, IsSection51FromAUniformStart) {
  const Problem small(83, 40, 0.3, 21), large(9999, 80, 0.02, 25);  // the large one has several tiles and panels
  for (const auto& [p, iterations] : {std::pair(&small, 1), {&small, 2}, {&small, 10}, {&large, 10}}) {
    const auto slow = slow_mlem(*p, iterations);
    const auto fast = mlem(p->rows, p->s, iterations);
    for (std::size_t j = 0; j < p->cells; ++j)
      ASSERT_NEAR(fast[j], slow[j], kSums * slow[j] + 1e-12) << "cell " << j << " n " << iterations;
  }
}

TEST(Mlem, ItsFirstStepFromKeptSumsIsTheStepItselfBitForBit) {
  const Problem p(9999, 140, 0.02, 22);
  std::vector<double> lambda(padded(p.cells), 1.0);
  mlem_step(p.rows, p.s, lambda);
  EXPECT_EQ(mlem(p.rows, p.s, 1), lambda);
}

TEST(Mlem, ConservesCountsAndNeverLowersTheLikelihood) {
  const Problem p(120, 60, 0.2, 23);
  std::vector<double> lambda(padded(p.cells), 1.0);
  mlem_step(p.rows, p.s, lambda);
  for (int step = 0; step < 30; ++step) {
    const double before = p.log_likelihood(lambda);
    mlem_step(p.rows, p.s, lambda);
    EXPECT_NEAR(std::inner_product(p.s.begin(), p.s.end(), lambda.begin(), 0.0), 60.0, kSums * 60.0) << "step " << step;
    EXPECT_GE(p.log_likelihood(lambda), before - kSums) << "step " << step;
  }
}

TEST(Mlem, LeavesCellsThatNobodySawAtZero) {
  Problem p(64, 20, 0.3, 24);
  p.s[5] = p.s[40] = 0.0;
  const auto lambda = mlem(p.rows, p.s, 10);
  EXPECT_EQ(lambda[5], 0.0);
  EXPECT_EQ(lambda[40], 0.0);
  for (const double value : lambda) EXPECT_TRUE(std::isfinite(value));
}

TEST(Mlem, IsAllZeroWithoutRows) {
  const SystemRows rows(10);
  EXPECT_EQ(mlem(rows, std::vector<double>(padded(10), 1.0), 10), std::vector<double>(padded(10), 0.0));
}

}  // namespace
}  // namespace comptonaut
