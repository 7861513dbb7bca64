// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "flight/route.h"

namespace comptonaut {

class Config;

/// The published search [Werner 2024]. Thresholds, number of clusters and memory are not published.
struct Werner2024Config {
  double s_min_s = 5e-9;          ///< explore where the sensitivity to pairs is lower: expected pairs per Bq
  double s_max_s = 5e-8;          ///< exploit maxima of lambda where it is lower
  int explore_clusters = 30;      ///< K: exploration cells are reduced to so many
  double visit_memory_s = 20.0;   ///< what was reached within this time
  double visit_radius_m = 2.0;    ///< is not visited again within this distance
  double replan_period_s = 10.0;  ///< lists are kept so long, unless a MAV has come to the end of its own
};

struct ZigzagConfig {
  double lane_m = 2.0;  ///< distance of lanes
};

struct SearchConfig {
  std::string strategy = "werner2024";  ///< "werner2024", "zigzag", "none"
  double set_height_m = 2.0;            ///< of waypoints above the surface
  double reach_m = 1.0;                 ///< a waypoint counts as reached from this distance, horizontally
  int legs_ahead = 16;                  ///< of a course
  int route_tries = 3;                  ///< targets tried where the first has no way
  RouteConfig route;                    ///< legs; its fence is set from the area by the coordinator
  Werner2024Config werner2024;
  ZigzagConfig zigzag;
};

[[nodiscard]] SearchConfig read_search_config(Config& config);

}  // namespace comptonaut
