// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scenario.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <tuple>

#include "config/config.h"
#include "nodes/plan_of.h"
#include "scratch.h"
#include "sim/fit.h"

namespace comptonaut {
namespace {

const std::filesystem::path kScenarios = std::filesystem::path(COMPTONAUT_SOURCE_DIR) / "config/scenarios";

std::filesystem::path written(const std::string& text) { return scratch_file("scenario_test.yaml", text); }

std::string refusal(const std::string& text) {
  try {
    (void)load_scenario(written(text));
  } catch (const ConfigError& e) {
    return e.what();
  }
  return "accepted";
}

const std::string kHead = "name: a\nhorizon_s: 10\narea: {x_min_m: 0, x_max_m: 50, y_min_m: 0, y_max_m: 50}\n";

TEST(Scenario, EachShippedOneLoadsAndDrawsItsSources) {
  const std::vector<std::pair<std::string, std::size_t>> shipped = {{"werner2024-sim", 5},
                                                                    {"werner2024-field", 3},
                                                                    {"hectare", 5},
                                                                    {"weak", 5},
                                                                    {"wide", 10},
                                                                    {"patch", 2},
                                                                    {"robust-response", 5},
                                                                    {"robust-background", 5},
                                                                    {"robust-cones", 5},
                                                                    {"robust-height", 5},
                                                                    {"two-nuclides", 5},
                                                                    {"beside-another", 2},
                                                                    {"town", 4}};
  for (const auto& [name, sources] : shipped) {
    const Scenario scenario = load_scenario(kScenarios / (name + ".yaml"));
    EXPECT_EQ(scenario.name, name);
    EXPECT_EQ(draw_sources(scenario, 1).size(), sources) << name;
    EXPECT_EQ(scenario.mavs.start_W.size(), static_cast<std::size_t>(scenario.mavs.count)) << name;
  }
}

TEST(Scenario, TheDocumentedFileNamesTheDefaults) {
  const Scenario documented = load_scenario(kScenarios / "werner2024-sim.yaml");
  const Scenario bare = load_scenario(written(kHead + "mavs: {count: 3}\n"));
  EXPECT_EQ(documented.mavs.start_W, bare.mavs.start_W);
  EXPECT_EQ(documented.mavs.speed_max_m_s, bare.mavs.speed_max_m_s);
  EXPECT_EQ(documented.mismatch.attitude_sigma_rad, bare.mismatch.attitude_sigma_rad);
  EXPECT_EQ(documented.mismatch.scatter_share, bare.mismatch.scatter_share);
  EXPECT_EQ(documented.mismatch.dead_time_us, bare.mismatch.dead_time_us);
  EXPECT_EQ(documented.mismatch.background_drift, bare.mismatch.background_drift);
  EXPECT_EQ(documented.mismatch.stray_share, bare.mismatch.stray_share);
  EXPECT_EQ(documented.draw.height_m, bare.draw.height_m);
  EXPECT_EQ(documented.traps.lost_data_s, bare.traps.lost_data_s);
  EXPECT_EQ(documented.background_singles_per_s, bare.background_singles_per_s);
}

TEST(Scenario, SourcesKeepTheirDistancesAndMargins) {
  for (const std::string name : {"werner2024-sim", "werner2024-field", "wide", "patch"}) {
    const Scenario scenario = load_scenario(kScenarios / (name + ".yaml"));
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
      const std::vector<TrueSource> sources = draw_sources(scenario, seed);
      for (std::size_t i = 0; i < sources.size(); ++i) {
        const Eigen::Vector3d& p_W = sources[i].p_W;
        EXPECT_GE(p_W.x(), scenario.area.x_min_m + 1.0) << name << " seed " << seed;
        EXPECT_LE(p_W.y(), scenario.area.y_max_m - 1.0) << name << " seed " << seed;
        for (std::size_t j = 0; j < i; ++j) {
          EXPECT_GE((p_W - sources[j].p_W).norm(), scenario.draw.distance_min_m) << name << " seed " << seed;
        }
        if (scenario.patch) {
          const double to_centre_m = (p_W.head<2>() - Eigen::Vector2d(scenario.patch->x_m, scenario.patch->y_m)).norm();
          EXPECT_GE(to_centre_m, scenario.patch->radius_m + scenario.draw.distance_min_m) << name << " seed " << seed;
        }
      }
    }
  }
}

TEST(Scenario, SourcesAreOfTheNuclidesThatItNames) {
  const Scenario scenario =
      load_scenario(written(kHead + "mavs: {count: 1}\nmore_nuclides: [Co-60-1332]\n"
                                    "sources: [{x_m: 1, y_m: 1, activity_Bq: 1.0e9, nuclide: Co-60-1332}]\n"
                                    "sources_by_seed: {activities_Bq: [1.0e9, 1.0e9, 1.0e9], "
                                    "nuclides: [Cs-137, Co-60-1332]}\n"));
  std::vector<std::string> nuclides;
  for (const TrueSource& source : draw_sources(scenario, 1)) nuclides.push_back(source.nuclide);
  EXPECT_EQ(nuclides, (std::vector<std::string>{"Co-60-1332", "Cs-137", "Co-60-1332", "Cs-137"}));
  const std::string refused =
      refusal(kHead + "mavs: {count: 1}\nsources_by_seed: {activities_Bq: [1.0e9], nuclides: [Co-60-1332]}\n");
  EXPECT_NE(refused.find("nuclides: Co-60-1332 is not allowed"), std::string::npos) << refused;
}

TEST(Scenario, TheSameSeedDrawsTheSameSourcesAndAnotherSeedOthers) {
  const Scenario scenario = load_scenario(kScenarios / "wide.yaml");
  const auto first = draw_sources(scenario, 7), again = draw_sources(scenario, 7), other = draw_sources(scenario, 8);
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].p_W, again[i].p_W);
    EXPECT_EQ(first[i].activity_Bq, again[i].activity_Bq);
    EXPECT_NE(first[i].p_W, other[i].p_W);
  }
}

TEST(Scenario, LogUniformActivitiesHaveTheirMedianAtTheGeometricMean) {
  Scenario scenario = load_scenario(kScenarios / "wide.yaml");
  std::vector<double> activities_Bq;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    for (const TrueSource& source : draw_sources(scenario, seed)) activities_Bq.push_back(source.activity_Bq);
  }
  std::sort(activities_Bq.begin(), activities_Bq.end());
  EXPECT_GE(activities_Bq.front(), 2.0e8);
  EXPECT_LE(activities_Bq.back(), 2.0e9);
  EXPECT_NEAR(activities_Bq[1000] / std::sqrt(2.0e8 * 2.0e9), 1.0, 0.1);
}

/// The team looks for what may lie there; of a list it knows nothing.
TEST(Scenario, ADrawnRangeOfActivitiesIsWhatTheTeamLooksFor) {
  const auto file = kScenarios.parent_path() / "coordinator.yaml";
  const CoordinatorConfig own = load_config(file, read_coordinator_config);
  for (const auto& [name, min_Bq, max_Bq] :
       {std::tuple("wide", 2.0e8, 2.0e9), {"werner2024-sim", own.joint.activity_min_Bq, own.joint.activity_max_Bq}}) {
    const Scenario scenario = load_scenario(kScenarios / (std::string(name) + ".yaml"));
    CoordinatorConfig fitted = own;
    fit_to(scenario, fitted);
    const CoordinatorConfig of_file =
        parse_config(fitted_coordinator_yaml(scenario, file, {}), file, read_coordinator_config);
    for (const CoordinatorConfig& coordinator : {fitted, of_file}) {
      const SearchFacts facts = search_facts(coordinator, ResponseTable::load(own.response_table), {});
      EXPECT_EQ(facts.activity_min_Bq, min_Bq) << name;
      EXPECT_EQ(facts.activity_max_Bq, max_Bq) << name;
      EXPECT_EQ(coordinator.joint.activity_min_Bq, min_Bq) << name;
      EXPECT_EQ(coordinator.joint.activity_max_Bq, max_Bq) << name;
    }
  }
}

TEST(Scenario, ListedSourcesStayWhereTheyAre) {
  const Scenario scenario =
      load_scenario(written(kHead + "mavs: {count: 1}\nsources: [{x_m: 10, y_m: 20, activity_Bq: 2.0e9}]\n"
                                    "sources_by_seed: {activities_Bq: [1.0e8], distance_min_m: 20}\n"));
  const auto sources = draw_sources(scenario, 3);
  ASSERT_EQ(sources.size(), 2u);
  EXPECT_EQ(sources[0].p_W, Eigen::Vector3d(10, 20, 0));
  EXPECT_GE((sources[1].p_W - sources[0].p_W).norm(), 20.0);
}

TEST(Scenario, SourcesStandAsHighAsToldAndOtherwiseInTheSamePlaces) {
  const std::string mavs = "mavs: {count: 1}\nsources: [{x_m: 10, y_m: 20, z_m: 1.5, activity_Bq: 2.0e9}]\n";
  const std::string draw = "sources_by_seed: {activities_Bq: [1.0e8, 1.0e8], distance_min_m: 8";
  const auto low = draw_sources(load_scenario(written(kHead + mavs + draw + "}\n")), 3);
  const auto high = draw_sources(load_scenario(written(kHead + mavs + draw + ", height_m: 1}\n")), 3);
  EXPECT_EQ(low[0].p_W, Eigen::Vector3d(10, 20, 1.5));
  EXPECT_EQ(high[0].p_W, Eigen::Vector3d(10, 20, 1.5));
  for (std::size_t k = 1; k < 3; ++k) EXPECT_EQ(high[k].p_W, low[k].p_W + Eigen::Vector3d(0, 0, 1)) << k;
}

TEST(Scenario, RefusesByFileLineAndKey) {
  const std::vector<std::pair<std::string, std::string>> refused = {
      {"name: a\nhorizon_s: 10\nmavs: {count: 3}\n", "scenario_test.yaml:1: area: is missing"},
      {kHead, "mavs: is missing"},
      {kHead + "mavs: {count: 0}\n", "scenario_test.yaml:4: mavs.count: '0'"},
      {kHead + "mavs: {count: 3, colour: red}\n", "scenario_test.yaml:4: mavs.colour: unknown key"},
      {kHead + "mavs: {count: 16}\n", "mavs.count"},
      {kHead + "mavs: {count: 15}\n", "mavs.count: 15 MAVs do not fit"},
      {kHead + "mavs: {count: 2, start: [{x_m: 1, y_m: 1}]}\n", "mavs.start"},
      {kHead + "mavs: {count: 1}\nsources: [{x_m: 51, y_m: 1, activity_Bq: 1.0e9}]\n", "sources[0].x_m"},
      {kHead + "mavs: {count: 1}\nsources_by_seed: {distance_min_m: 3}\n", "sources_by_seed.activities_Bq"},
      {kHead + "mavs: {count: 1}\nsources: [{x_m: 1, y_m: 1, z_m: -1, activity_Bq: 1.0e9}]\n", "sources[0].z_m"},
      {kHead + "mavs: {count: 1}\nsources_by_seed: {count: 0, height_m: -1}\n", "sources_by_seed"},
      {kHead + "mavs: {count: 1}\nmismatch: {stray_share: 1.1}\n", "mismatch.stray_share"},
      {kHead + "mavs: {count: 1}\nmismatch: {background_drift: 0}\n", "mismatch.background_drift"},
      {kHead + "mavs: {count: 1}\nrange_sensor: {period_s: 0.025}\n",
       "range_sensor.period_s: is 0.025, must be a multiple"},
      {kHead + "mavs: {count: 1}\ntraps: {epoch_fault_share: 2}\n", "scenario_test.yaml:5: traps.epoch_fault_share"},
      {"name: a\nhorizon_s: 10.5\narea: {x_min_m: 0, x_max_m: 5, y_min_m: 0, y_max_m: 5}\nmavs: {count: 1}\n",
       "whole seconds"},
  };
  for (const auto& [text, wanted] : refused) {
    EXPECT_NE(refusal(text).find(wanted), std::string::npos) << text << "says: " << refusal(text);
  }
}

TEST(Scenario, RefusesDistancesThatLeaveNoRoom) {
  Scenario scenario = load_scenario(kScenarios / "werner2024-sim.yaml");
  scenario.draw.distance_min_m = 49.0;
  EXPECT_THROW((void)draw_sources(scenario, 1), std::runtime_error);
}

TEST(Scenario, IdealHasNoMismatchAndNoTraps) {
  Scenario scenario = load_scenario(kScenarios / "werner2024-sim.yaml");
  scenario.traps.hot_pixels = 3;
  const Scenario ideal = idealised(scenario);
  EXPECT_EQ(ideal.mismatch.position_sigma_m + ideal.mismatch.attitude_sigma_rad + ideal.mismatch.boresight_sigma_rad +
                ideal.mismatch.response_sigma + ideal.mismatch.scatter_share + ideal.mismatch.dead_time_us,
            0.0);
  EXPECT_EQ(ideal.traps.hot_pixels, 0);
}

}  // namespace
}  // namespace comptonaut
