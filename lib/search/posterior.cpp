// SPDX-License-Identifier: BSD-3-Clause
#include "search/posterior.h"

namespace comptonaut {

CountsAbove counts_above(const CoarseGround& ground, std::span<const Look> looks) {
  const Eigen::ArrayXf none = Eigen::ArrayXf::Zero(static_cast<Eigen::Index>(ground.size()));
  CountsAbove counts{.live_s = none, .counted = none, .expected = none};
  for (const Look& look : looks) {
    const auto i = static_cast<Eigen::Index>(ground.at(look.p_WD));
    counts.live_s(i) += static_cast<float>(look.live_s);
    counts.counted(i) += static_cast<float>(look.singles);
    counts.expected(i) += static_cast<float>(look.expected);
  }
  return counts;
}

CountsAbove as_expected(const Eigen::ArrayXf& live_s, const Eigen::ArrayXf& rate_per_s) {
  return {.live_s = live_s, .counted = live_s * rate_per_s, .expected = live_s * rate_per_s};
}

Eigen::ArrayXXf log_odds(const Eigen::ArrayXXf& kernel, std::span<const double> activities_Bq,
                         const CountsAbove& counts, double expected_rel_sigma) {
  const auto variance = static_cast<float>(expected_rel_sigma * expected_rel_sigma);
  Eigen::ArrayXXf sums = Eigen::ArrayXXf::Zero(kernel.rows(), std::ssize(activities_Bq));
  for (Eigen::Index i = 0; i < kernel.cols(); ++i) {
    if (counts.live_s(i) <= 0.0F || counts.expected(i) <= 0.0F) continue;
    const float trust = 1.0F / (1.0F + variance * counts.expected(i));
    for (Eigen::Index k = 0; k < sums.cols(); ++k) {
      const float activity_Bq = static_cast<float>(activities_Bq[static_cast<std::size_t>(k)]);
      const auto more = kernel.col(i) * (activity_Bq * counts.live_s(i));
      sums.col(k) -= trust * more;
      const float counted = trust * counts.counted(i);
      if (counted > 0.0F) sums.col(k) += counted * (1.0F + more / counts.expected(i)).log();
    }
  }
  return sums.max(kDenied);
}

Eigen::ArrayXXf hidden_chances(const CoarseGround& ground, const Eigen::ArrayXXf& log_odds, double expected) {
  constexpr double kMost = 600.0;  // whose exp is still a number
  const double prior = expected / static_cast<double>(log_odds.size());
  const Eigen::ArrayXXd odds = prior * log_odds.cast<double>().min(kMost).exp();
  const Eigen::ArrayXd of_square = odds.rowwise().sum();
  Eigen::ArrayXd all = Eigen::ArrayXd::Ones(of_square.size());
  for (std::size_t j = 0; j < ground.size(); ++j) {
    for (std::size_t i = 0; i < ground.size(); ++i) {
      const bool shared = (ground.p_W(i) - ground.p_W(j)).head<2>().squaredNorm() <= kShared_m * kShared_m;
      if (shared) all(static_cast<Eigen::Index>(j)) += of_square(static_cast<Eigen::Index>(i));
    }
  }
  return (odds.colwise() / all).cast<float>();
}

}  // namespace comptonaut
