// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/upper_limit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"

namespace comptonaut {
namespace {

double slow_limit(const ActivityEvidence& e, double chance, double end_Bq) {
  constexpr int kSteps = 40'000;
  const double h = end_Bq / kSteps;
  const auto log_l = [&](double A) {
    double sum = -e.sensitivity_s * A;
    for (std::size_t k = 0; k < e.counts.size(); ++k) sum += e.counts[k] * std::log1p(e.ratios_per_Bq[k] * A);
    return sum;
  };
  double largest = 0.0, all = 0.0, sum = 0.0;
  for (int i = 0; i < kSteps; i += 10) largest = std::max(largest, log_l(h * i));
  for (int i = 0; i < kSteps; ++i) all += std::exp(log_l(h * (i + 0.5)) - largest);
  for (int i = 0; i < kSteps; ++i) {
    sum += std::exp(log_l(h * (i + 0.5)) - largest);
    if (sum >= (1.0 - chance) * all) return h * (i + 1);
  }
  return end_Bq;
}

ActivityEvidence drawn(Random& random, double source_Bq) {
  ActivityEvidence e;
  for (int k = 0; k < 40; ++k) {
    const double expected = 0.05 + random.uniform(), per_Bq = 1e-8 / (0.1 + 10.0 * random.uniform());
    e.sensitivity_s += per_Bq;
    const auto n = static_cast<double>(random.poisson(expected + per_Bq * source_Bq));
    if (n == 0.0) continue;
    e.ratios_per_Bq.push_back(per_Bq / expected);
    e.counts.push_back(n);
  }
  return e;
}

TEST(UpperLimit, IsThreeCountsWhereNothingWasCounted) {
  EXPECT_NEAR(upper_limit_Bq({.sensitivity_s = 1e-7}, 0.05), -std::log(0.05) / 1e-7, 1e-2 / 1e-7);
  EXPECT_TRUE(std::isinf(upper_limit_Bq({}, 0.05)));
}

TEST(UpperLimit, IsTheQuantileOfTheWholeLikelihood) {
  Random random(71);
  for (int i = 0; i < 30; ++i) {
    const ActivityEvidence e = drawn(random, 2e7 * (i % 5));
    const double limit_Bq = upper_limit_Bq(e, 0.05);
    EXPECT_NEAR(limit_Bq, slow_limit(e, 0.05, 8.0 * limit_Bq), 0.01 * limit_Bq) << "draw " << i;
    EXPECT_GE(limit_Bq, 0.999 * -std::log(0.05) / e.sensitivity_s) << "draw " << i;
  }
}

TEST(UpperLimit, TakesSmallTermsAsOne) {
  Random random(72);
  const ActivityEvidence whole = drawn(random, 0.0);
  const double limit_Bq = upper_limit_Bq(whole, 0.05);
  ActivityEvidence split{.sensitivity_s = whole.sensitivity_s};
  double nr = 0.0, nrr = 0.0;
  for (std::size_t k = 0; k < whole.counts.size(); ++k) {
    const double r = whole.ratios_per_Bq[k], n = whole.counts[k];
    if (r * limit_Bq < 0.2) {
      nr += n * r, nrr += n * r * r;
    } else {
      split.ratios_per_Bq.push_back(r), split.counts.push_back(n);
    }
  }
  ASSERT_GT(nr, 0.0);
  split.ratios_per_Bq.push_back(nrr / nr), split.counts.push_back(nr * nr / nrr);
  EXPECT_NEAR(upper_limit_Bq(split, 0.05), limit_Bq, 0.01 * limit_Bq);
}

/// Drawn from a source, the limit is below it in about one of twenty draws, whatever its strength.
TEST(UpperLimit, CoversTheTruthNineteenTimesOfTwenty) {
  Random random(73);
  for (const double source_Bq : {2e6, 1e7, 1e8, 1e9}) {
    constexpr int kDraws = 2000;
    int covered = 0;
    for (int i = 0; i < kDraws; ++i) covered += upper_limit_Bq(drawn(random, source_Bq), 0.05) > source_Bq ? 1 : 0;
    EXPECT_GE(covered, 0.935 * kDraws) << source_Bq;
    EXPECT_LE(covered, (source_Bq >= 1e8 ? 0.97 : 1.0) * kDraws) << source_Bq;
  }
}

}  // namespace
}  // namespace comptonaut
