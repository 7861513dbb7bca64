// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace comptonaut {

class Config;

/// Algorithm 1 of Werner 2024. Thresholds, number of clusters and memory are not published.
struct Werner2024Config {
  double s_min_s = 2e-9;          ///< explore where the sensitivity to pairs is lower, expected pairs per Bq
  double s_max_s = 2e-8;          ///< exploit maxima of lambda where it is lower
  int explore_clusters = 30;      ///< K: exploration cells are reduced to so many
  double visit_memory_s = 20.0;   ///< a place reached within this time
  double visit_radius_m = 2.0;    ///< and this distance is not visited again
  double replan_period_s = 10.0;  ///< a MAV keeps its list so long, unless one of the team runs out
};

struct ZigzagConfig {
  double lane_m = 2.0;  ///< distance of lanes
};

struct SearchConfig {
  std::string strategy = "werner2024";  ///< "werner2024", "zigzag", "none"
  double set_height_m = 2.0;            ///< of waypoints above the surface
  double reach_m = 1.0;                 ///< a waypoint counts as reached from this distance, horizontally
  Werner2024Config werner2024;
  ZigzagConfig zigzag;
};

[[nodiscard]] SearchConfig read_search_config(Config& config);

}  // namespace comptonaut
