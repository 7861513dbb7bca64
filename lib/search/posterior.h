// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>

#include "radiation/look.h"
#include "search/coarse_ground.h"

namespace comptonaut {

/// What the team counted above each square, and what was to be expected there of background and known sources.
struct CountsAbove {
  Eigen::ArrayXf live_s, counted, expected;
};

[[nodiscard]] CountsAbove counts_above(const CoarseGround& ground, std::span<const Look> looks);

/// Where nobody tells the counts: nothing but what was expected at these rates.
[[nodiscard]] CountsAbove as_expected(const Eigen::ArrayXf& live_s, const Eigen::ArrayXf& rate_per_s);

/// Log likelihood of one source more, of activity A in square j, against none [square j, activity]:
///   sum_i [n_i log(1 + A k_ji T_i / e_i) - A k_ji T_i] / (1 + sigma^2 e_i)
/// over the squares i that were flown over: n_i singles in the time T_i, e_i expected, and the kernel k_ji singles per
/// Bq and s. Not below kDenied. What is expected may be wrong by a share sigma, expected_rel_sigma: a source that is
/// not known yet is put down to those that are known, which then are expected to give more than they do. So where much
/// was expected, what was counted denies little.
[[nodiscard]] Eigen::ArrayXXf log_odds(const Eigen::ArrayXXf& kernel, std::span<const double> activities_Bq,
                                       const CountsAbove& counts, double expected_rel_sigma);

inline constexpr float kDenied = -5.0F;

/// The chance that a source of that activity hides in square j: its odds over 1 plus the odds of all squares and
/// activities within kShared_m of it, since counts are explained by one source at a time. Before anything is seen,
/// `expected` sources hide anywhere.
[[nodiscard]] Eigen::ArrayXXf hidden_chances(const CoarseGround& ground, const Eigen::ArrayXXf& log_odds,
                                             double expected);

inline constexpr double kShared_m = 7.5;

}  // namespace comptonaut
