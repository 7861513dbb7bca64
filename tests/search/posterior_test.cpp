// SPDX-License-Identifier: BSD-3-Clause
#include "search/posterior.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "search/outlook.h"

namespace comptonaut {
namespace {

constexpr double kActivity_Bq = 1e8;

/// Everything that the odds of a field are made of; each square is looked at for a second from its middle.
struct Looked {
  explicit Looked(const Area& area = {0, 30, 0, 30})
      : field(area), ground(field.cells, 2.5, 1600), kernel(singles_kernels(ground, field.state(), 2.0)[0][0]) {
    for (std::size_t i = 0; i < ground.size(); ++i) {
      looks.push_back({.p_WD = ground.p_W(i) + 2.0 * Eigen::Vector3d::UnitZ(), .live_s = 1.0, .expected = 3.0});
    }
  }

  [[nodiscard]] Eigen::ArrayXXf odds(const std::vector<double>& activities_Bq = {kActivity_Bq},
                                     double expected_rel_sigma = 0.0) const {
    return log_odds(kernel, activities_Bq, counts_above(ground, looks), expected_rel_sigma);
  }
  /// Counts as they are to be expected of a source in square j besides.
  void put_source(std::size_t j, double activity_Bq) {
    for (std::size_t i = 0; i < looks.size(); ++i) {
      looks[i].singles =
          3.0 + activity_Bq * static_cast<double>(kernel(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(i)));
    }
  }

  Field field;
  CoarseGround ground;
  Eigen::ArrayXXf kernel;
  std::vector<Look> looks;
};

/// Poisson's log likelihood, up to what all models share.
double log_poisson(double counted, double expected) { return counted * std::log(expected) - expected; }

TEST(Posterior, OddsAreTheRatioOfPoissonLikelihoods) {
  Looked seen;
  std::mt19937_64 random(3);
  for (Look& look : seen.looks) {
    look.expected = std::uniform_real_distribution(1.0, 9.0)(random);
    look.singles = std::poisson_distribution(look.expected)(random);
    look.live_s = std::uniform_real_distribution(0.0, 0.2)(random);
  }
  const Eigen::ArrayXXf odds = seen.odds();
  for (std::size_t j = 0; j < seen.looks.size(); ++j) {
    double ratio = 0.0;
    for (std::size_t i = 0; i < seen.looks.size(); ++i) {
      const Look& look = seen.looks[i];
      const double more = kActivity_Bq * look.live_s *
                          static_cast<double>(seen.kernel(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(i)));
      ratio += log_poisson(look.singles, look.expected + more) - log_poisson(look.singles, look.expected);
    }
    EXPECT_NEAR(odds(static_cast<Eigen::Index>(j), 0), std::max(ratio, static_cast<double>(kDenied)), 1e-3) << j;
  }
}

/// Of squares that are alike, each says a share of what it says if what is expected is known.
TEST(Posterior, WhereMuchWasExpectedLittleIsDenied) {
  Looked seen;
  for (const double expected : {1.0, 10.0, 1000.0}) {
    for (Look& look : seen.looks) look.expected = look.singles = expected;
    const std::vector activities_Bq = {1e6, 1e7};
    const Eigen::ArrayXXf sure = seen.odds(activities_Bq), unsure = seen.odds(activities_Bq, 0.5);
    ASSERT_TRUE((sure > kDenied).all());
    EXPECT_LT((unsure * static_cast<float>(1.0 + 0.25 * expected) - sure).abs().maxCoeff(), 1e-4F) << expected;
  }
}

TEST(Posterior, LooksThatAreSplitTellTheSame) {
  Looked seen;
  seen.put_source(30, kActivity_Bq);
  const Eigen::ArrayXXf whole = seen.odds();
  const std::size_t n = seen.looks.size();
  for (std::size_t i = 0; i < n; ++i) {
    Look& look = seen.looks[i];
    look = {
        .p_WD = look.p_WD, .live_s = 0.5 * look.live_s, .singles = 0.5 * look.singles, .expected = 0.5 * look.expected};
    seen.looks.push_back(Look(look));
  }
  EXPECT_LT((seen.odds() - whole).abs().maxCoeff(), 1e-4F);
}

TEST(Posterior, CountsShowWhereAndEmptyGroundIsDenied) {
  Looked seen;
  const std::size_t j = seen.ground.at({11.0, 18.0, 0.0});
  seen.put_source(j, 3e8);
  const Eigen::ArrayXXf odds = seen.odds({1e8, 3e8, 1e10});
  Eigen::Index square = 0, level = 0;
  odds.maxCoeff(&square, &level);
  EXPECT_EQ(static_cast<std::size_t>(square), j);
  EXPECT_EQ(level, 1);
  EXPECT_GT(odds(square, level), 18.0F);
  EXPECT_FLOAT_EQ(odds(static_cast<Eigen::Index>(seen.ground.at({29.0, 1.0, 0.0})), 2), kDenied);

  const Eigen::ArrayXXf chances = hidden_chances(seen.ground, odds, 5.0);
  EXPECT_GT(chances(square, level), 0.5F);
  EXPECT_LT(chances.col(2).maxCoeff(), 1e-3F);
}

TEST(Posterior, BeforeAnythingIsSeenAllPlacesAreAlikeAndNoSourceIsCountedTwice) {
  Looked seen;
  const Eigen::ArrayXXf none = log_odds(seen.kernel, std::vector{1e8, 1e9}, counts_above(seen.ground, {}), 0.8);
  ASSERT_TRUE((none == 0.0F).all());
  for (const double expected : {1e-3, 5.0, 1e3}) {
    const Eigen::ArrayXXf chances = hidden_chances(seen.ground, none, expected);
    EXPECT_LE(chances.sum(), static_cast<float>(expected));
    const Eigen::ArrayXf of_square = chances.rowwise().sum();
    for (std::size_t j = 0; j < seen.ground.size(); ++j) {
      float near = 0.0F;  // what one place is the middle of
      for (std::size_t i = 0; i < seen.ground.size(); ++i) {
        if ((seen.ground.p_W(i) - seen.ground.p_W(j)).norm() <= 0.5 * kShared_m)
          near += of_square(static_cast<Eigen::Index>(i));
      }
      EXPECT_LE(near, 1.0F + 1e-5F) << expected;
    }
  }
}

TEST(Posterior, NothingButWhatWasExpectedDeniesStrongSourcesMore) {
  const Looked seen;
  const Eigen::ArrayXf ones = Eigen::ArrayXf::Ones(seen.kernel.rows());
  const Eigen::ArrayXXf odds = log_odds(seen.kernel, std::vector{1e7, 1e8}, as_expected(0.1F * ones, 3.0F * ones), 0.0);
  EXPECT_TRUE((odds < 0.0F).all());
  EXPECT_TRUE((odds.col(1) < odds.col(0) || odds.col(1) == kDenied).all());
}

}  // namespace
}  // namespace comptonaut
