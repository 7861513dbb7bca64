// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "search/courses.h"
#include "search/lookahead.h"
#include "search/prospect.h"
#include "search/strategy.h"

namespace comptonaut {

/// Flies where the next seconds answer most (design, section 6.3): each tick, for one MAV after another, each counting
/// what those before it will see, the flight of some legs that gains most worth per second. What a MAV was about to do
/// is kept unless something else is clearly better.
///
/// Ends when no square may hide a source of activity_min_Bq and every source is known as well as asked: the team flies
/// to where it was first seen. It goes on when a source appears.
class Information : public Strategy {
 public:
  explicit Information(const SearchConfig& config);
  std::vector<Course> plan(const SearchState& state) override;

 private:
  void remember(const SearchState& state);
  void choose(const SearchState& state, const Prospect& prospect);
  [[nodiscard]] Lookahead outlook(const SearchState& state, const Prospect& prospect, const Searcher& mav) const;
  [[nodiscard]] FlightPath choice(const SearchState& state, const Searcher& mav, const Lookahead& lookahead,
                                  const FlightPath& start) const;

  SearchConfig config_;
  std::optional<CoarseGround> ground_;
  Kernels kernels_;
  Eigen::ArrayXf live_s_;  ///< above each square
  std::map<std::int32_t, Eigen::Vector3d> homes_W_;
  Targets targets_;
};

}  // namespace comptonaut
