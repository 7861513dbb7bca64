// SPDX-License-Identifier: BSD-3-Clause
#include "campaign_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "core/statistics.h"
#include "sim/campaign_figures.h"

namespace comptonaut {
namespace {

/// Moments of a run that maps show, as shares of the horizon: what happens, happens early.
constexpr std::array<double, 5> kShown = {0.05, 0.1, 0.2, 0.4, 1.0};

double success_s(const MissionResult& mission) {
  return time_to_success_s(mission.steps).value_or(std::numeric_limits<double>::infinity());
}

QuartileCurve quartiles(std::span<const MissionResult> missions,
                        const std::function<double(const Localisation&)>& number) {
  QuartileCurve curve;
  for (std::size_t i = 0; i < missions.front().steps.size(); ++i) {
    std::vector<double> values;
    for (const MissionResult& mission : missions) values.push_back(number(mission.steps[i].localisation));
    curve.lower.push_back(quantile(values, 0.25));
    curve.median.push_back(median(values));
    curve.upper.push_back(quantile(values, 0.75));
  }
  return curve;
}

ComparedRun run_of(const MissionResult& mission) {
  ComparedRun run{.track_period_s = seconds(kTrackPeriod_us)};
  for (const TrueSource& source : mission.sources) run.sources_W.emplace_back(source.p_W.head<2>());
  for (const TrueTrack& track : mission.tracks) {
    auto& places = run.tracks_W.emplace_back();
    for (const Eigen::Vector3f& p_W : track) places.emplace_back(p_W.head<2>());
  }
  const auto steps = static_cast<double>(mission.steps.size());
  for (const double share : kShown) {
    const auto i = static_cast<std::size_t>(std::max(1.0, share * steps)) - 1;
    const Judgement& step = mission.steps[i];
    ReportedMoment moment{.t_s = step.t_s, .rmse_m = step.localisation.rmse_m, .found = step.localisation.found_2m};
    for (const PointSource& source : step.reported) moment.reported.push_back({source.p_W.head<2>(), true});
    for (const int found_by : step.localisation.found_by) {
      if (found_by >= 0) moment.reported[found_by].is_false = false;
    }
    run.moments.push_back(moment);
  }
  return run;
}

ComparedTeam team_of(const CampaignPart& part, std::uint64_t seed) {
  const CampaignFigures figures = figures_of(part.missions);
  ComparedTeam team{.strategy = part.names.strategy,
                    .estimator = part.names.estimator,
                    .runs = part.missions.size(),
                    .success_s = figures.success_s,
                    .success_median_s = figures.success_median_s,
                    .success_worst_s = figures.success_worst_s,
                    .never = figures.never,
                    .rmse_mean_m = figures.rmse_mean_m,
                    .found_mean = figures.found_mean,
                    .false_mean = figures.false_mean,
                    .distance_min_m = figures.distance_min_m,
                    .collisions = figures.collisions,
                    .outside_s = figures.outside_s,
                    .at_home = figures.at_home,
                    .flights = figures.mavs};
  for (const MissionResult& mission : part.missions) {
    if (mission.seed == seed) team.run = run_of(mission);
  }
  team.rmse_m = quartiles(part.missions, [](const Localisation& l) { return l.rmse_m; });
  team.found = quartiles(part.missions, [](const Localisation& l) { return static_cast<double>(l.found_2m); });
  return team;
}

/// The missions of the first part whose seeds all parts have, by time to success; the middle one's seed.
std::uint64_t shown_seed(std::span<const CampaignPart> parts) {
  const auto has = [](const CampaignPart& part, std::uint64_t seed) {
    return part.missions.empty() ||
           std::ranges::any_of(part.missions, [seed](const MissionResult& m) { return m.seed == seed; });
  };
  const auto first = std::ranges::find_if(parts, [](const CampaignPart& part) { return !part.missions.empty(); });
  if (first == parts.end()) return 0;
  std::vector<std::pair<double, std::uint64_t>> common;
  for (const MissionResult& mission : first->missions) {
    const bool everywhere = std::ranges::all_of(parts, [&](const CampaignPart& p) { return has(p, mission.seed); });
    if (everywhere) common.emplace_back(success_s(mission), mission.seed);
  }
  std::ranges::sort(common);
  return common.empty() ? first->missions.front().seed : common[(common.size() - 1) / 2].second;
}

}  // namespace

Comparison comparison_of(std::span<const CampaignPart> parts, const CampaignFacts& facts) {
  Comparison comparison{.scenario = facts.scenario,
                        .area = facts.area,
                        .buildings = facts.buildings,
                        .horizon_s = facts.horizon_s,
                        .run = shown_seed(parts),
                        .mavs = static_cast<std::size_t>(facts.mavs)};
  std::vector<std::uint64_t> seeds;
  for (const CampaignPart& part : parts) {
    if (part.missions.empty()) continue;
    for (const MissionResult& mission : part.missions) seeds.push_back(mission.seed);
    comparison.sources = part.missions.front().sources.size();
    comparison.teams.push_back(team_of(part, comparison.run));
  }
  if (seeds.empty()) return comparison;
  const auto [first, last] = std::ranges::minmax(seeds);
  comparison.seeds = first == last ? fmt::format("{}", first) : fmt::format("{}:{}", first, last);
  return comparison;
}

}  // namespace comptonaut
