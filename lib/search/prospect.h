// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "search/coarse_ground.h"
#include "search/strategy.h"

namespace comptonaut {

/// What the team wants to know, as a list of questions: for each square and each of some activities, whether a source
/// of that activity lies there; for each known source, where exactly, and whether it is one: seen from afar, two may
/// look like one between them, until somebody flies over it. Knowledge of a question is a number that grows with time
/// in view, 1 where it may count as answered: it is worth  weight * (1 - exp(-known)).
struct Prospect {
  Eigen::ArrayXf known;       ///< so far
  Eigen::ArrayXf weight;      ///< they sum up to 1 for the squares, source_weight + visit_weight for each source
  Eigen::ArrayXXf per_s;      ///< [question, square]: what a second above a square adds
  std::vector<bool> flyable;  ///< [square]: whether MAVs may be above it
  bool all_clear = false;     ///< no flyable square may still hide a source of the least activity
  bool all_precise = false;   ///< every source is known as well as asked
};

/// Singles per Bq and second, seen at set height above one square (column) from another one (row).
[[nodiscard]] Eigen::ArrayXXf singles_kernel(const CoarseGround& ground, const SearchState& state, double set_height_m);

/// Of an activity A in square j, a second above square i brings  (A k)^2 / (A k + r)  counts' worth: k the kernel, r
/// the singles that are expected there of background and known sources. counts_to_find of them answer the question.
/// The activities are spaced evenly in their logarithm, so the strong ones are found first, and what is left is ever
/// weaker. A source's position: the same counts over d^2, on what its covariance says; source_sigma_m is an answer.
/// A visit: time above the source, visit_s of it.
/// `live_s` is the time that was spent above each square.
[[nodiscard]] Prospect make_prospect(const CoarseGround& ground, const Eigen::ArrayXXf& kernel,
                                     const SearchState& state, const SearchConfig& config,
                                     const Eigen::ArrayXf& live_s);

/// Sum over the questions of weight * (1 - exp(-known)).
[[nodiscard]] double worth(const Prospect& prospect, const Eigen::ArrayXf& known);

}  // namespace comptonaut
