// SPDX-License-Identifier: BSD-3-Clause
#include "sim/campaign_figures.h"

#include <algorithm>
#include <limits>

#include "core/statistics.h"

namespace comptonaut {

CampaignFigures figures_of(std::span<const MissionResult> missions) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  CampaignFigures figures{.distance_min_m = kNever};
  double rmse_m = 0.0, found = 0.0, wrong = 0.0;
  for (const MissionResult& mission : missions) {
    figures.success_s.push_back(time_to_success_s(mission.steps).value_or(kNever));
    if (figures.success_s.back() == kNever) ++figures.never;
    const Localisation& end = mission.steps.back().localisation;
    rmse_m += end.rmse_m;
    found += end.found_2m;
    wrong += end.false_reports;
    figures.distance_min_m = std::min(figures.distance_min_m, mission.distance_min_m);
    figures.outside_s += mission.outside_s;
    figures.collisions += mission.collisions;
    figures.at_home += mission.at_home;
    figures.mavs += mission.tracks.size();
  }
  const auto runs = static_cast<double>(missions.size());
  figures.rmse_mean_m = rmse_m / runs;
  figures.found_mean = found / runs;
  figures.false_mean = wrong / runs;
  figures.success_median_s = median(figures.success_s);
  figures.success_worst_s = std::ranges::max(figures.success_s);
  return figures;
}

}  // namespace comptonaut
