// SPDX-License-Identifier: BSD-3-Clause
#include "core/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace comptonaut {
namespace {

constexpr int kDraws = 200'000;
const double kFiveSigma = 5.0 / std::sqrt(static_cast<double>(kDraws));

TEST(Random, SameSeedAndStreamGiveTheSameNumbers) {
  Random a(7, 3), b(7, 3), other_stream(7, 4), other_seed(8, 3);
  int same_stream = 0, same_seed = 0;
  for (int i = 0; i < 100; ++i) {
    const auto x = a();
    EXPECT_EQ(x, b());
    same_stream += x == other_stream();
    same_seed += x == other_seed();
  }
  EXPECT_EQ(same_stream + same_seed, 0);
}

TEST(Random, MomentsAreThoseOfTheDistributions) {
  Random random(1);
  double uniform = 0, normal = 0, normal2 = 0, exponential = 0, small = 0, large = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double u = random.uniform();
    EXPECT_TRUE(u >= 0.0 && u < 1.0);
    const double n = random.normal();
    uniform += u;
    normal += n;
    normal2 += n * n;
    exponential += random.exponential();
    small += static_cast<double>(random.poisson(0.3));
    large += static_cast<double>(random.poisson(50.0));
  }
  EXPECT_NEAR(uniform / kDraws, 0.5, kFiveSigma * std::sqrt(1.0 / 12.0));
  EXPECT_NEAR(normal / kDraws, 0.0, kFiveSigma);
  EXPECT_NEAR(normal2 / kDraws, 1.0, kFiveSigma * std::sqrt(2.0));
  EXPECT_NEAR(exponential / kDraws, 1.0, kFiveSigma);
  EXPECT_NEAR(small / kDraws, 0.3, kFiveSigma * std::sqrt(0.3));
  EXPECT_NEAR(large / kDraws, 50.0, kFiveSigma * std::sqrt(50.0));
  EXPECT_EQ(random.poisson(0.0), 0);
}

TEST(Random, PoissonNumbersHaveTheirMeanAndVariance) {
  Random random(3);
  for (const double mean : {0.01, 3.0, 499.0, 500.0, 1234.5}) {
    double sum = 0, squares = 0;
    constexpr int kNumbers = 20'000;
    for (int i = 0; i < kNumbers; ++i) {
      const double off = static_cast<double>(random.poisson(mean)) - mean;
      sum += off;
      squares += off * off;
    }
    EXPECT_NEAR(sum / kNumbers, 0.0, 5.0 * std::sqrt(mean / kNumbers)) << mean;
    EXPECT_NEAR(squares / kNumbers / mean, 1.0, 5.0 * std::sqrt((2.0 + 1.0 / mean) / kNumbers)) << mean;
  }
  EXPECT_EQ(random.poisson(-1.0), 0);
}

TEST(Random, DirectionsAreUnitAndIsotropic) {
  Random random(2);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d outer = Eigen::Matrix3d::Zero();
  for (int i = 0; i < kDraws; ++i) {
    const Eigen::Vector3d u = random.unit_vector();
    EXPECT_NEAR(u.norm(), 1.0, 1e-12);
    sum += u;
    outer += u * u.transpose();
  }
  EXPECT_LT((sum / kDraws).norm(), 2.0 * kFiveSigma);
  EXPECT_LT((outer / kDraws - Eigen::Matrix3d::Identity() / 3.0).norm(), 2.0 * kFiveSigma);
}

}  // namespace
}  // namespace comptonaut
