// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "search/courses.h"
#include "search/strategy.h"

namespace comptonaut {

/// The sweep: the cells' bounding rectangle in equal strips, one per MAV, each flown in lanes along the rectangle's
/// longer side, not farther apart than lane_m. A MAV begins at the corner of its strip nearest to it, and flies back
/// the same way when it has come to the end. A team that grows or shrinks shares the area out anew.
class Zigzag : public Strategy {
 public:
  explicit Zigzag(const SearchConfig& config);
  std::vector<Course> plan(const SearchState& state) override;

 private:
  void make_lists(const SearchState& state);

  SearchConfig config_;
  Targets sweeps_;   ///< a MAV's whole way, in the sense that it flies now
  Targets targets_;  ///< what is left of it
};

/// Lanes that cover a rectangle, as corners to fly to one after another. `lanes_along_x`: lanes are parallel to x.
[[nodiscard]] std::vector<Eigen::Vector2d> lane_corners(const Area& strip, double lane_m, bool lanes_along_x);

}  // namespace comptonaut
