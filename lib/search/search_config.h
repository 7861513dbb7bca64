// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

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

/// The search for information (design, section 6.3).
struct InformationConfig {
  double square_m = 2.5;  ///< the ground in squares so large, or larger where there would be too many
  int squares_max = 1600;
  int activities = 3;                     ///< that are looked for, between the least and the largest
  double counts_to_find = 25.0;           ///< expected singles, worth of background, by which a source counts as found
  double sources_expected = 5.0;          ///< all over the ground, before anything was seen
  double background_singles_per_s = 3.0;  ///< per MAV
  double expected_rel_sigma = 0.8;        ///< share by which what is expected above a square may be wrong
  double source_sigma_m = 0.25;           ///< asked of each source's position, per axis
  double source_weight = 0.01;            ///< of a source, where all ground together weighs 1
  double visit_weight = 0.03;             ///< likewise, of a visit to a source:
  double visit_distance_m = 3.0;  ///< the time above it, less by exp(-(d / visit_distance_m)^2 / 2) from beside,
  double visit_s = 0.3;           ///< compared to this
  double stretch_m = 8.0;         ///< legs are multiples of it,
  double leg_max_m = 32.0;        ///< at most so long
  double horizon_s = 14.0;        ///< flights are thought of until they last so long
  double patience_s = 20.0;       ///< what comes after t seconds counts exp(-t / patience_s)
  int legs_ahead = 5;             ///< at most
  int paths_kept = 8;             ///< at each leg
  double keep_factor = 1.05;      ///< a new course must be so much better than the present one
};

/// All that make_strategy knows.
inline const std::vector<std::string> kStrategies = {"information", "werner2024", "zigzag", "none"};

/// Sources that a MAV must not come near: its detector would saturate, its electronics suffer.
struct KeepOutConfig {
  double activity_min_Bq = 0.0;  ///< of sources that are kept away from; 0: none
  double radius_m = 5.0;         ///< horizontally, at any height
};

struct SearchConfig {
  std::string strategy = "information";  ///< one of kStrategies
  double set_height_m = 2.0;             ///< of waypoints above the surface
  double reach_m = 1.0;                  ///< a waypoint counts as reached from this distance, horizontally
  int legs_ahead = 16;                   ///< of a course
  int route_tries = 3;                   ///< targets tried where the first has no way
  RouteConfig route;                     ///< legs; the border of its fence is set by the coordinator
  std::vector<Area> look_first;          ///< areas to fly over before the strategy leads
  KeepOutConfig keep_out;
  InformationConfig information;
  Werner2024Config werner2024;
  ZigzagConfig zigzag;
};

[[nodiscard]] SearchConfig read_search_config(Config& config);

}  // namespace comptonaut
