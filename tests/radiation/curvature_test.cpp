// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/curvature.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "radiation/cell_centres.h"

namespace comptonaut {
namespace {

struct Problem {
  std::size_t n;
  std::vector<std::vector<double>> rows;
  std::vector<double> gradient, x;

  Problem(std::size_t n_, std::size_t n_rows, std::uint64_t seed) : n(n_) {
    Random random(seed);
    for (std::size_t r = 0; r < n_rows; ++r) {
      std::vector<double>& row = rows.emplace_back();
      for (std::size_t i = 0; i < n; ++i) row.push_back(static_cast<float>(random.normal()));
    }
    for (std::size_t i = 0; i < n; ++i) {
      gradient.push_back(3.0 * random.normal());
      x.push_back(random.uniform(0.0, 0.1));
    }
  }
  [[nodiscard]] double H(std::size_t i, std::size_t j) const {
    double sum = 0.0;
    for (const std::vector<double>& row : rows) sum += row[i] * row[j];
    return sum;
  }
  [[nodiscard]] AlignedVector<float> fast() const {
    Curvature curvature(n);
    for (const std::vector<double>& row : rows) std::copy(row.begin(), row.end(), curvature.next_row());
    return curvature.finish();
  }
};

TEST(Curvature, IsTheSumOfItsRowsProducts) {
  for (const auto& [n, rows] : {std::pair<std::size_t, std::size_t>{1, 1}, {16, 16}, {17, 33}, {53, 100}, {5, 0}}) {
    const Problem p(n, rows, 41);
    const AlignedVector<float> H = p.fast();
    ASSERT_EQ(H.size(), n * padded(n));
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        ASSERT_NEAR(H[i * padded(n) + j], p.H(i, j), 1e-5 * static_cast<double>(rows)) << i << ", " << j << " of " << n;
      }
    }
  }
}

/// Whatever may still move has no slope left, whatever is at its bound would only go below it.
TEST(Curvature, ItsBestStepLeavesNoSlopeButIntoBounds) {
  const Problem p(40, 120, 42);
  const QuadraticStep best = quadratic_step(p.fast(), p.gradient, p.x, 1e-6);
  double gain = 0.0;
  int bound = 0;
  for (std::size_t i = 0; i < p.n; ++i) {
    double slope = p.gradient[i];
    for (std::size_t j = 0; j < p.n; ++j) slope -= p.H(i, j) * best.step[j];
    gain += 0.5 * best.step[i] * (p.gradient[i] + slope);
    ASSERT_GE(p.x[i] + best.step[i], 0.0) << i;
    if (p.x[i] + best.step[i] > 0.0) {
      EXPECT_NEAR(slope, 0.0, 1e-3) << i;
    } else {
      EXPECT_LE(slope, 1e-3) << i;
      ++bound;
    }
  }
  EXPECT_GT(bound, 3);
  EXPECT_NEAR(best.gain, gain, 1e-4 * gain);
}

TEST(Curvature, LeavesAloneWhatNoRowKnows) {
  const QuadraticStep best = quadratic_step(Problem(3, 0, 43).fast(), std::vector<double>{1.0, -1.0, 2.0},
                                            std::vector<double>{1.0, 1.0, 1.0}, 1e-6);
  EXPECT_EQ(best.step, std::vector<double>(3, 0.0));
  EXPECT_EQ(best.gain, 0.0);
}

}  // namespace
}  // namespace comptonaut
