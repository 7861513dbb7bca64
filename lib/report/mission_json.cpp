// SPDX-License-Identifier: BSD-3-Clause
#include "report/mission_json.h"

#include "report/json_parts.h"
#include "report/scores.h"

namespace comptonaut {
namespace {

using nlohmann::json;

/// Estimates of one tick: [x_m, y_m, activity_Bq, true source that it found or -1].
json estimates_to_json(const MissionRecord& record, const SourceReport& report, const Localisation* tick) {
  json list = json::array();
  for (const PointSource& estimate : shown_estimates(record, report)) {
    list.push_back({rounded(estimate.p_W.x(), 2), rounded(estimate.p_W.y(), 2), std::round(estimate.activity_Bq), -1});
  }
  if (tick == nullptr) return list;
  for (std::size_t source = 0; source < tick->found_by.size(); ++source) {
    if (tick->found_by[source] >= 0) list[tick->found_by[source]][3] = source;
  }
  return list;
}

json ticks_to_json(const MissionRecord& record, const MissionScores& scores) {
  json ticks = {{"t_s", json::array()}, {"coverage", json::array()}, {"estimates", json::array()}};
  for (std::size_t i = 0; i < record.reports.size(); ++i) {
    const SourceReport& report = record.reports[i];
    const Localisation* tick = scores.ticks.empty() ? nullptr : &scores.ticks[i];
    ticks["t_s"].push_back(rounded(record.t_s(report.utime), 2));
    ticks["coverage"].push_back(rounded(report.coverage, 4));
    ticks["estimates"].push_back(estimates_to_json(record, report, tick));
    if (tick == nullptr) continue;
    ticks["rmse_nearest_m"].push_back(rounded(tick->rmse_nearest_m, 3));
    ticks["rmse_m"].push_back(rounded(tick->rmse_m, 3));
    ticks["found_2m"].push_back(tick->found_2m);
    ticks["found_half_m"].push_back(tick->found_half_m);
    ticks["false"].push_back(tick->false_reports);
    ticks["activity_error_rel"].push_back(rounded(tick->activity_error_rel, 4));
    json nearest = json::array();
    for (const double d_m : tick->nearest_m) nearest.push_back(rounded(d_m, 3));
    ticks["nearest_m"].push_back(nearest);
  }
  return ticks;
}

json truth_to_json(const Truth& truth) {
  json sources = json::array();
  for (const TrueSource& source : truth.sources) {
    sources.push_back({{"nuclide", source.nuclide},
                       {"x_m", rounded(source.p_W.x(), 3)},
                       {"y_m", rounded(source.p_W.y(), 3)},
                       {"z_m", rounded(source.p_W.z(), 3)},
                       {"activity_Bq", source.activity_Bq}});
  }
  return {{"scenario", truth.scenario},
          {"time_scale", truth.time_scale},
          {"area_m", {truth.area.x_min_m, truth.area.x_max_m, truth.area.y_min_m, truth.area.y_max_m}},
          {"sources", sources}};
}

/// The last report's sources with all that the estimator tells of them.
json final_sources_to_json(const MissionRecord& record) {
  json list = json::array();
  if (record.reports.empty()) return list;
  const SourceReport& report = record.reports.back();
  for (std::size_t i = 0; i < shown_estimates(record, report).size(); ++i) {
    const SourceEstimate& source = report.sources[i];
    list.push_back({{"nuclide", source.nuclide},
                    {"z_m", rounded(source.p_W.z(), 2)},
                    {"sigma_x_m", rounded(source.position_sigma_m.x(), 3)},
                    {"sigma_y_m", rounded(source.position_sigma_m.y(), 3)},
                    {"activity_sigma_Bq", source.activity_sigma_Bq},
                    {"significance", rounded(source.significance, 1)}});
  }
  return list;
}

json coordinator_to_json(const CoordinatorState& state, int leaders) {
  return {{"sender", state.sender},
          {"term", state.term},
          {"terms", leaders},
          {"cones", state.cones},
          {"viewpoints", state.viewpoints}};
}

json more_maps_to_json(const MissionRecord& record) {
  json maps = json::array();
  for (const MapRecord& map : record.more_maps) maps.push_back(map_to_json(record, map));
  return maps;
}

}  // namespace

std::string mission_to_json(const MissionRecord& record) {
  const MissionScores scores = score(record);
  json page = {{"headline", headline(record, scores)},
               {"remarks", remarks(record)},
               {"start_utime_us", record.start_utime},
               {"duration_s", rounded(record.duration_s(), 2)},
               {"estimator", record.reports.empty() ? "" : record.reports.back().estimator},
               {"success_s", nullptr},
               {"truth", nullptr},
               {"coordinator", nullptr},
               {"recording", {{"messages", record.messages}, {"others", record.others}}},
               {"ticks", ticks_to_json(record, scores)},
               {"final_sources", final_sources_to_json(record)},
               {"drones", drones_to_json(record)},
               {"daemons", daemons_to_json(record)},
               {"map", map_to_json(record, record.map)},
               {"more_maps", more_maps_to_json(record)},
               {"buildings_m", areas_to_json(record.buildings)},
               {"clearance", clearance_to_json(record)},
               {"patches", patches_to_json(record)}};
  if (scores.success_s) page["success_s"] = rounded(*scores.success_s, 2);
  if (record.truth) page["truth"] = truth_to_json(*record.truth);
  if (record.coordinator) page["coordinator"] = coordinator_to_json(*record.coordinator, record.leaders);
  return script_text(page);
}

}  // namespace comptonaut
