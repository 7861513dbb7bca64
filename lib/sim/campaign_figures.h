// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sim/mission_result.h"

namespace comptonaut {

/// What the missions of one configuration come to, for tables and pages alike. Means are over the missions, at the
/// horizon; what happens in flight is summed over all of them.
struct CampaignFigures {
  std::vector<double> success_s;  ///< of each mission; infinite: none before the horizon
  double success_median_s = 0.0, success_worst_s = 0.0;
  int never = 0;  ///< missions without success
  double rmse_mean_m = 0.0, found_mean = 0.0, false_mean = 0.0;
  double distance_min_m = 0.0;  ///< between two MAVs, in all missions; infinite for one MAV
  double outside_s = 0.0;       ///< as in MissionResult
  int collisions = 0;
  int at_home = 0;
  std::size_t mavs = 0;  ///< that took off, of which at_home came back
};

/// Of one mission at least, each with one step at least.
[[nodiscard]] CampaignFigures figures_of(std::span<const MissionResult> missions);

}  // namespace comptonaut
