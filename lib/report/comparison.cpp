// SPDX-License-Identifier: BSD-3-Clause
#include "report/comparison.h"

#include "report/json_parts.h"
#include "report/page_text.h"

namespace comptonaut {
namespace {

using nlohmann::json;

/// NaN and infinities become null.
json numbers_to_json(const std::vector<double>& values) {
  json numbers = json::array();
  for (const double value : values) numbers.push_back(rounded(value, 3));
  return numbers;
}

json curve_to_json(const QuartileCurve& curve) {
  return {{"lower", numbers_to_json(curve.lower)},
          {"median", numbers_to_json(curve.median)},
          {"upper", numbers_to_json(curve.upper)}};
}

template <typename Points>
json places_to_json(const Points& points_W) {
  json places = json::array();
  for (const auto& p_W : points_W) places.push_back({rounded(p_W.x(), 2), rounded(p_W.y(), 2)});
  return places;
}

json run_to_json(const ComparedRun& run) {
  json tracks = json::array(), moments = json::array();
  for (const auto& track : run.tracks_W) tracks.push_back(places_to_json(track));
  for (const ReportedMoment& moment : run.moments) {
    json reported = json::array();
    for (const ReportedPlace& place : moment.reported) {
      reported.push_back({rounded(place.p_W.x(), 2), rounded(place.p_W.y(), 2), place.is_false});
    }
    moments.push_back(
        {{"t_s", moment.t_s}, {"rmse_m", rounded(moment.rmse_m, 3)}, {"found", moment.found}, {"reported", reported}});
  }
  return {{"sources_m", places_to_json(run.sources_W)},
          {"tracks_m", tracks},
          {"track_period_s", run.track_period_s},
          {"moments", moments}};
}

json team_to_json(const ComparedTeam& team) {
  return {{"strategy", team.strategy},
          {"estimator", team.estimator},
          {"runs", team.runs},
          {"success_s", numbers_to_json(team.success_s)},
          {"success_median_s", team.success_median_s},
          {"success_worst_s", team.success_worst_s},
          {"never", team.never},
          {"rmse_mean_m", team.rmse_mean_m},
          {"found_mean", team.found_mean},
          {"false_mean", team.false_mean},
          {"distance_min_m", team.distance_min_m},
          {"collisions", team.collisions},
          {"outside_s", rounded(team.outside_s, 2)},
          {"at_home", team.at_home},
          {"flights", team.flights},
          {"rmse_m", curve_to_json(team.rmse_m)},
          {"found", curve_to_json(team.found)},
          {"run", run_to_json(team.run)}};
}

}  // namespace

std::string comparison_html(const Comparison& comparison) {
  json teams = json::array();
  for (const ComparedTeam& team : comparison.teams) teams.push_back(team_to_json(team));
  const json data = {{"scenario", comparison.scenario},
                     {"area_m", area_to_json(comparison.area)},
                     {"buildings_m", areas_to_json(comparison.buildings)},
                     {"horizon_s", comparison.horizon_s},
                     {"seeds", comparison.seeds},
                     {"run", comparison.run},
                     {"mavs", comparison.mavs},
                     {"sources", comparison.sources},
                     {"teams", teams}};
  return with_data(kComparisonText, script_text(data));
}

}  // namespace comptonaut
