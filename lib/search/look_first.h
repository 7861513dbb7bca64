// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "search/courses.h"
#include "search/strategy.h"

namespace comptonaut {

/// Flies over the areas config.look_first before another strategy leads: places in a grid over them, shared out so that
/// the team is done early, each MAV's in the order of a short tour. A MAV that is done is led by the other strategy at
/// once. Places where no MAV may be are left out. A team that grows or shrinks shares out anew what is left.
class LookFirst : public Strategy {
 public:
  LookFirst(const SearchConfig& config, std::unique_ptr<Strategy> then);
  std::vector<Course> plan(const SearchState& state) override;

 private:
  void list_places(const SearchState& state);
  void share_out(const SearchState& state);

  SearchConfig config_;
  std::unique_ptr<Strategy> then_;
  bool listed_ = false;
  std::vector<Eigen::Vector3d> places_W_;  ///< not shared out yet
  std::vector<std::int32_t> team_;         ///< that the targets were shared out among
  Targets targets_;
};

}  // namespace comptonaut
