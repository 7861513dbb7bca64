// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "core/cells.h"

namespace comptonaut {

/// One number of all runs of a configuration, per second from 1 s on.
struct QuartileCurve {
  std::vector<double> lower, median, upper;
};

struct ReportedPlace {
  Eigen::Vector2d p_W = Eigen::Vector2d::Zero();
  bool is_false = false;  ///< no true source within 2 m was given to it
};

/// What one run reported at one moment.
struct ReportedMoment {
  double t_s = 0.0;
  double rmse_m = 0.0;
  int found = 0;  ///< true sources within 2 m of an estimate of their own
  std::vector<ReportedPlace> reported;
};

/// A run as its map is shown.
struct ComparedRun {
  std::vector<Eigen::Vector2d> sources_W;              ///< true ones
  std::vector<std::vector<Eigen::Vector2f>> tracks_W;  ///< one per MAV, a place every track_period_s from 0 s on
  double track_period_s = 0.2;
  std::vector<ReportedMoment> moments;  ///< in the order of time
};

/// One strategy with one estimator. Times are infinite beyond the horizon. Means are over the runs, at the horizon.
struct ComparedTeam {
  std::string strategy, estimator;
  std::size_t runs = 0;
  std::vector<double> success_s;  ///< of each run
  double success_median_s = 0.0, success_worst_s = 0.0;
  int never = 0;  ///< runs without success
  double rmse_mean_m = 0.0, found_mean = 0.0, false_mean = 0.0;
  double distance_min_m = 0.0;  ///< between two MAVs, in all runs; infinite for one MAV
  int collisions = 0;           ///< with obstacles, in all runs
  double outside_s = 0.0;       ///< that MAVs spent outside the fence, summed over all runs
  int at_home = 0;              ///< MAVs that ended where they began, of `flights`
  std::size_t flights = 0;      ///< MAVs of all runs
  QuartileCurve rmse_m, found;
  ComparedRun run;
};

/// A campaign of several configurations, for one page. Runs of different teams are of the same seeds.
struct Comparison {
  std::string scenario;
  Area area;
  std::vector<Area> buildings;  ///< drawn below the flights; they do not overlap
  double horizon_s = 0.0;
  std::string seeds;      ///< "1:20"
  std::uint64_t run = 0;  ///< seed of the run whose maps are shown
  std::size_t mavs = 0;
  std::size_t sources = 0;          ///< in each run
  std::vector<ComparedTeam> teams;  ///< with one run at least
};

/// One self-contained HTML page: no network, no other file.
[[nodiscard]] std::string comparison_html(const Comparison& comparison);

}  // namespace comptonaut
