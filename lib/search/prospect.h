// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "search/channels.h"
#include "search/coarse_ground.h"
#include "search/hover_places.h"
#include "search/open_questions.h"
#include "search/strategy.h"

namespace comptonaut {

/// What the team wants to know, as a list of questions: for each nuclide, each square and each of some activities,
/// whether such a source lies there; for each known source, where exactly, and whether it is one: seen from afar, two
/// may look like one between them, until somebody flies over it. Knowledge of a question is a number that grows with
/// time in view, 1 where it may count as answered: it is worth  weight * (1 - exp(-known)).
struct Prospect {
  Eigen::ArrayXf known;       ///< so far; of squares 0: what was seen of them is in their weight
  Eigen::ArrayXf weight;      ///< of squares the chance that the source is there, over how many are expected; of each
                              ///< source source_weight + visit_weight
  Eigen::ArrayXXf per_s;      ///< [question, square]: what a second above a square adds
  std::vector<View> views;    ///< [square]: the same, to look at
  std::vector<bool> flyable;  ///< [square]: whether MAVs may be above it
  std::vector<bool> unseen;   ///< [square]: it may still hide a source of the least activity, but nobody may fly there
  bool all_clear = false;     ///< no flyable square may still hide one
  bool all_precise = false;   ///< every source is known as well as asked
};

/// Of an activity A in square j, a second above square i brings  (A k)^2 / (A k + r)  counts' worth: k the kernel, r
/// the singles that are expected there of background and known sources. counts_to_find of them answer the question.
/// The activities are spaced evenly in their logarithm. What was counted so far says how likely such a source is
/// (hidden_chances), so strong ones are found or denied first, and what is left is ever weaker; and how much of
/// facts.gain_to_add it has got already, so that so much less is asked for. Ground that nobody may fly over weighs as
/// much less as one sees of it less from beside than from above. A source's position: the same counts over
/// d^2, on what its covariance says; source_sigma_m is an answer. A visit: time above the source, visit_s of it.
/// Of several nuclides each is asked for on its own, as if it were an equal share of the sources that are expected;
/// what its photons leave, or do not leave, in the channels below counts with what they give in its own
/// (Evidence). `live_s` is the time that was spent above each square, `hover_W` where one can hover there.
[[nodiscard]] Prospect make_prospect(const CoarseGround& ground, const Kernels& kernels, const SearchState& state,
                                     const SearchConfig& config, const Eigen::ArrayXf& live_s,
                                     const HoverPlaces& hover_W);

}  // namespace comptonaut
