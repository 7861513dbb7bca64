// SPDX-License-Identifier: BSD-3-Clause
#include "sim/campaign_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "sim/campaign_figures.h"

namespace comptonaut {
namespace {

constexpr std::array<double, 4> kTimes_s = {60.0, 120.0, 220.0, 300.0};

/// A time to success in words.
std::string success_text(double t_s, std::span<const MissionResult> missions) {
  const double horizon_s = missions.front().steps.back().t_s;
  return t_s > horizon_s ? fmt::format("more than {:.0f} s", horizon_s) : fmt::format("{:.0f} s", t_s);
}

std::string success_line(const CampaignFigures& figures, std::span<const MissionResult> missions) {
  return fmt::format("time to success: median {}, worst {} ({} of {} runs never)\n",
                     success_text(figures.success_median_s, missions), success_text(figures.success_worst_s, missions),
                     figures.never, missions.size());
}

/// Mean over the missions of one number at t_s, "-" beyond the horizon.
std::string mean_at(std::span<const MissionResult> missions, double t_s,
                    const std::function<double(const Localisation&)>& number) {
  double sum = 0.0;
  for (const MissionResult& mission : missions) {
    const auto step = std::find_if(mission.steps.begin(), mission.steps.end(),
                                   [&](const Judgement& judgement) { return judgement.t_s == t_s; });
    if (step == mission.steps.end()) return "-";
    sum += number(step->localisation);
  }
  return fmt::format("{:.2f}", sum / static_cast<double>(missions.size()));
}

std::string table_row(const std::string& name, std::span<const MissionResult> missions,
                      const std::function<double(const Localisation&)>& number) {
  std::string row = fmt::format("{:<28}", name);
  for (const double t_s : kTimes_s) row += fmt::format("{:>9}", mean_at(missions, t_s, number));
  return row + "\n";
}

std::string table(std::span<const MissionResult> missions) {
  std::string text = fmt::format("{:<28}", "mean over seeds, after");
  for (const double t_s : kTimes_s) text += fmt::format("{:>7.0f} s", t_s);
  const std::size_t sources = missions.front().steps.front().localisation.nearest_m.size();
  text += "\n";
  text += table_row("RMSE to the nearest, m", missions, [](const Localisation& l) { return l.rmse_nearest_m; });
  text += table_row("RMSE one to one, m", missions, [](const Localisation& l) { return l.rmse_m; });
  text += table_row(fmt::format("found within 2 m (of {})", sources), missions,
                    [](const Localisation& l) { return static_cast<double>(l.found_2m); });
  text += table_row("found within 0.5 m", missions,
                    [](const Localisation& l) { return static_cast<double>(l.found_half_m); });
  text += table_row("false", missions, [](const Localisation& l) { return static_cast<double>(l.false_reports); });
  return text;
}

/// How the sources found stand at the end, and how often 95 % intervals hold the truth.
std::string ends(std::span<const MissionResult> missions) {
  constexpr double kQuantile95 = 1.959963984540054;
  int exact = 0, intervals = 0, hold_position = 0, hold_activity = 0;
  double activity_squares = 0.0, found = 0.0, rmse_squares = 0.0, crb_squares = 0.0;
  for (const MissionResult& mission : missions) {
    const Judgement& end = mission.steps.back();
    if (all_found_none_false(end.localisation)) ++exact;
    rmse_squares += end.localisation.rmse_m * end.localisation.rmse_m;
    crb_squares += end.crb_m * end.crb_m;
    for (const SourceError& e : end.errors) {
      if (std::isnan(e.activity_rel)) continue;
      found += 1.0;
      activity_squares += e.activity_rel * e.activity_rel;
      if (std::isnan(e.activity_rel_sigma)) continue;
      ++intervals;
      hold_position += static_cast<int>(std::abs(e.x_m) <= kQuantile95 * e.x_sigma_m) +
                       static_cast<int>(std::abs(e.y_m) <= kQuantile95 * e.y_sigma_m);
      hold_activity += static_cast<int>(std::abs(e.activity_rel) <= kQuantile95 * e.activity_rel_sigma);
    }
  }
  std::string text = fmt::format("at the end: number of sources exact in {} of {} runs", exact, missions.size());
  if (found > 0.0) text += fmt::format(", activity error {:.1f} % RMS", 100.0 * std::sqrt(activity_squares / found));
  text += "\n";
  if (intervals > 0) {
    text += fmt::format("95 % intervals hold {:.0f} % of the coordinates, {:.0f} % of the activities\n",
                        50.0 * hold_position / intervals, 100.0 * hold_activity / intervals);
  }
  if (crb_squares > 0.0) {
    text += fmt::format("RMSE over the Cramer-Rao bound at the end: {:.2f} (bound {:.3f} m)\n",
                        std::sqrt(rmse_squares / crb_squares),
                        std::sqrt(crb_squares / static_cast<double>(missions.size())));
  }
  return text;
}

/// How patches stand at the end; empty where there are none.
std::string patch_line(std::span<const MissionResult> missions) {
  int found = 0, others = 0;
  double centroid_m2 = 0.0, area = 0.0, activity = 0.0;
  for (const MissionResult& mission : missions) {
    const Judgement& end = mission.steps.back();
    others += end.patches - (end.patch ? 1 : 0);
    if (!end.patch) continue;
    ++found;
    centroid_m2 += end.patch->centroid_m * end.patch->centroid_m;
    area += end.patch->area_rel * end.patch->area_rel;
    activity += end.patch->activity_rel * end.patch->activity_rel;
  }
  if (found + others == 0) return "";
  const auto rms = [found](double squares) { return std::sqrt(squares / std::max(1, found)); };
  return fmt::format(
      "patch at the end: told in {} of {} runs, {} elsewhere; RMS errors: area {:.1f} %, centroid {:.2f} m, activity "
      "{:.1f} %\n",
      found, missions.size(), others, 100.0 * rms(area), rms(centroid_m2), 100.0 * rms(activity));
}

std::string events_line(std::span<const MissionResult> missions) {
  EventTally sum;
  for (const MissionResult& mission : missions) {
    sum.singles += mission.events.singles;
    sum.pairs += mission.events.pairs;
    sum.others += mission.events.others;
  }
  const double percent = 100.0 / static_cast<double>(std::max<std::int64_t>(1, sum.all()));
  return fmt::format(
      "events: {:.1f} % singles, {:.1f} % pairs, {:.1f} % others of {:.0f} a mission (published flight: 93.4, 4.3, 2.3 "
      "%)\n",
      percent * static_cast<double>(sum.singles), percent * static_cast<double>(sum.pairs),
      percent * static_cast<double>(sum.others), static_cast<double>(sum.all()) / static_cast<double>(missions.size()));
}

std::string run_line(const CampaignFigures& figures, std::span<const MissionResult> missions) {
  double simulated_s = 0.0, cpu_s = 0.0;
  for (const MissionResult& mission : missions) {
    simulated_s += mission.steps.back().t_s;
    cpu_s += mission.cpu_s;
  }
  return fmt::format(
      "smallest distance between MAVs: {:.2f} m; collisions with obstacles: {}; outside the fence: {:.1f} s; at home "
      "at "
      "the end: {} of {} MAVs\n"
      "{:.1f} x real time on one core ({:.1f} s of processor time a mission)\n",
      figures.distance_min_m, figures.collisions, figures.outside_s, figures.at_home, figures.mavs, simulated_s / cpu_s,
      cpu_s / static_cast<double>(missions.size()));
}

std::string comparison_row(const CampaignPart& part) {
  const std::string name = fmt::format("{:<14}{:<10}", part.names.strategy, part.names.estimator);
  if (part.missions.empty()) return name + "no mission came to its end\n";
  const CampaignFigures figures = figures_of(part.missions);
  return name + fmt::format("{:>16}{:>16}{:>7}{:>9.2f}{:>8.2f}{:>7.2f}{:>12.2f}{:>6}\n",
                            success_text(figures.success_median_s, part.missions),
                            success_text(figures.success_worst_s, part.missions), figures.never, figures.rmse_mean_m,
                            figures.found_mean, figures.false_mean, figures.distance_min_m, part.missions.size());
}

}  // namespace

std::string campaign_summary(const CampaignPart& part) {
  const auto& [names, missions] = part;
  const std::string title =
      fmt::format("{}, strategy {}, estimator {}", names.scenario, names.strategy, names.estimator);
  if (missions.empty()) return title + ": no mission came to its end\n";
  const CampaignFigures figures = figures_of(missions);
  return title + fmt::format(", seeds {} to {}\n", missions.front().seed, missions.back().seed) +
         success_line(figures, missions) + table(missions) + ends(missions) + patch_line(missions) +
         events_line(missions) + run_line(figures, missions);
}

std::string campaign_comparison(std::span<const CampaignPart> parts) {
  std::string text =
      fmt::format("{:<14}{:<10}{:>16}{:>16}{:>7}{:>9}{:>8}{:>7}{:>12}{:>6}\n", "strategy", "estimator",
                  "success, median", "worst", "never", "RMSE, m", "found", "false", "distance, m", "runs");
  for (const CampaignPart& part : parts) text += comparison_row(part);
  return text;
}

}  // namespace comptonaut
