// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "search/courses.h"
#include "search/strategy.h"

namespace comptonaut {

/// The published search, Algorithm 1 of Werner 2024, whole (design, section 6.1).
///
/// A MAV's list is kept until some MAV of the team has come to the end of its own, or for replan_period_s. When lists
/// are made anew, each MAV still goes where it was going, and its new list follows: nobody turns round in mid-leg.
class Werner2024 : public Strategy {
 public:
  explicit Werner2024(const SearchConfig& config);
  std::vector<Course> plan(const SearchState& state) override;

  /// As they are now: they double when there is nothing left to do.
  [[nodiscard]] double s_min_s() const { return s_min_s_; }
  [[nodiscard]] double s_max_s() const { return s_max_s_; }

 private:
  struct Visit {
    Eigen::Vector3d p_W;
    Utime utime;
  };

  void remember_visits(const SearchState& state);
  [[nodiscard]] bool lists_are_due(const SearchState& state) const;
  void make_lists(const SearchState& state);
  [[nodiscard]] std::vector<Eigen::Vector3d> waypoints(const SearchState& state);
  [[nodiscard]] std::vector<Eigen::Vector3d> candidates(const SearchState& state) const;
  [[nodiscard]] bool recently_visited(const Eigen::Vector3d& p_W) const;

  SearchConfig config_;
  double s_min_s_, s_max_s_;
  Targets targets_;
  std::vector<Visit> visits_;
  Utime listed_utime_ = 0;
};

}  // namespace comptonaut
