// SPDX-License-Identifier: BSD-3-Clause
#include "search/search_config.h"

#include "config/area.h"
#include "config/config.h"

namespace comptonaut {
namespace {

void read_information(Config& config, InformationConfig& information) {
  config.read("square_m", information.square_m, {.min = 0.5, .max = 100.0});
  config.read("squares_max", information.squares_max, {.min = 1, .max = 10'000});
  config.read("activities", information.activities, {.min = 1, .max = 20});
  config.read("counts_to_find", information.counts_to_find, {.min = 0.1, .max = 1e4});
  config.read("sources_expected", information.sources_expected, {.min = 1e-3, .max = 1e6});
  config.read("background_singles_per_s", information.background_singles_per_s, {.min = 1e-3, .max = 1e6});
  config.read("expected_rel_sigma", information.expected_rel_sigma, {.min = 0.0, .max = 10.0});
  config.read("source_sigma_m", information.source_sigma_m, {.min = 0.01, .max = 100.0});
  config.read("source_weight", information.source_weight, {.min = 0.0, .max = 100.0});
  config.read("visit_weight", information.visit_weight, {.min = 0.0, .max = 100.0});
  config.read("visit_distance_m", information.visit_distance_m, {.min = 0.1, .max = 1e3});
  config.read("visit_s", information.visit_s, {.min = 1e-3, .max = 1e3});
  config.read("stretch_m", information.stretch_m, {.min = 0.5, .max = 1e3});
  config.read("leg_max_m", information.leg_max_m, {.min = 0.5, .max = 1e4});
  config.read("horizon_s", information.horizon_s, {.min = 1.0, .max = 1e3});
  config.read("patience_s", information.patience_s, {.min = 0.1, .max = 1e6});
  config.read("legs_ahead", information.legs_ahead, {.min = 1, .max = 20});
  config.read("paths_kept", information.paths_kept, {.min = 1, .max = 100});
  config.read("keep_factor", information.keep_factor, {.min = 1.0, .max = 10.0});
}

void read_werner2024(Config& config, Werner2024Config& werner2024) {
  config.read("s_min_s", werner2024.s_min_s, {.min = 1e-15, .max = 1.0});
  config.read("s_max_s", werner2024.s_max_s, {.min = 1e-15, .max = 1.0});
  config.read("explore_clusters", werner2024.explore_clusters, {.min = 1, .max = 1000});
  config.read("visit_memory_s", werner2024.visit_memory_s, {.min = 0.0, .max = 1e6});
  config.read("visit_radius_m", werner2024.visit_radius_m, {.min = 0.0, .max = 1e3});
  config.read("replan_period_s", werner2024.replan_period_s, {.min = 1.0, .max = 1e6});
}

void read_route(Config& config, RouteConfig& route) {
  config.read("envelope_radius_m", route.envelope.radius_m, {.min = 0.05, .max = 10.0});
  config.read("envelope_half_height_m", route.envelope.half_height_m, {.min = 0.05, .max = 10.0});
  config.read("margin_m", route.margin_m, {.min = 0.0, .max = 10.0});
  config.read("separation_m", route.separation.radius_m, {.min = 0.1, .max = 100.0});
  config.read("separation_half_height_m", route.separation.half_height_m, {.min = 0.1, .max = 100.0});
  config.read("step_m", route.step_m, {.min = 0.1, .max = 10.0});
  int expanded_max = static_cast<int>(route.expanded_max);
  config.read("expanded_max", expanded_max, {.min = 1, .max = 10'000'000});
  route.expanded_max = static_cast<std::size_t>(expanded_max);
}

}  // namespace

SearchConfig read_search_config(Config& config) {
  SearchConfig search;
  config.read("strategy", search.strategy, kStrategies);
  config.read("set_height_m", search.set_height_m, {.min = 0.5, .max = 100.0});
  config.read("reach_m", search.reach_m, {.min = 0.1, .max = 20.0});
  config.read("legs_ahead", search.legs_ahead, {.min = 1, .max = 100});
  config.read("route_tries", search.route_tries, {.min = 1, .max = 100});
  config.each("exclude",
              [&](Config& section) { search.route.fence.excluded.push_back(polygon_of(read_area(section))); });
  config.each("look_first", [&](Config& section) { search.look_first.push_back(read_area(section)); });
  config.section("keep_out", [&](Config& section) {
    section.require("activity_min_Bq", search.keep_out.activity_min_Bq, Range{1.0, 1e18});
    section.require("radius_m", search.keep_out.radius_m, Range{0.1, 1e3});
  });
  config.section("route", [&](Config& section) { read_route(section, search.route); });
  config.section("information", [&](Config& section) { read_information(section, search.information); });
  config.section("werner2024", [&](Config& section) { read_werner2024(section, search.werner2024); });
  config.section("zigzag",
                 [&](Config& section) { section.read("lane_m", search.zigzag.lane_m, {.min = 0.1, .max = 1e3}); });
  return search;
}

}  // namespace comptonaut
