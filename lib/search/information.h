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
/// is kept unless something else is clearly better. A place that no way leads to is left alone for a while, and
/// one that is walled in until the world changes.
///
/// Ends when no square may hide a source of activity_min_Bq and every source is known as well as asked: the team flies
/// to where it was first seen. It goes on when a source appears.
class Information : public Strategy {
 public:
  explicit Information(const SearchConfig& config);
  std::vector<Course> plan(const SearchState& state) override;

 private:
  /// A place that no way led to.
  struct LeftAlone {
    Eigen::Vector3d p_W;
    Utime since;
  };

  void remember(const SearchState& state);
  void leave_alone(std::int32_t mav, const Course& course, Utime utime);
  [[nodiscard]] bool is_left_alone(std::int32_t mav, const Eigen::Vector3d& p_W) const;
  [[nodiscard]] std::string said_at_the_end(const SearchState& state, const Prospect& prospect,
                                            const Searcher& mav) const;
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
  std::map<std::int32_t, std::vector<LeftAlone>> left_alone_;
  HoverPlaces hover_W_;           ///< that one can get to, as far as is known
  std::uint64_t world_hash_ = 0;  ///< of the world in which they are
};

}  // namespace comptonaut
