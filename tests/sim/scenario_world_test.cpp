// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "config/config.h"
#include "scratch.h"
#include "sim/fit.h"
#include "sim/scenario.h"
#include "sim/sim_world.h"
#include "test_camera.h"

namespace comptonaut {
namespace {

const std::string kTown =
    "name: a\nhorizon_s: 10\narea: {x_min_m: 0, x_max_m: 30, y_min_m: 0, y_max_m: 30}\n"
    "mavs: {count: 2}\n";
const std::string kHouse =
    "world:\n  boxes: [{x_min_m: 10, x_max_m: 20, y_min_m: 10, y_max_m: 20, z_max_m: 6}]\n  material: brick\n";

Scenario loaded(const std::string& text) { return load_scenario(scratch_file("scenario_world_test.yaml", text)); }

std::string refused(const std::string& text) {
  try {
    (void)loaded(text);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ScenarioWorld, IsMadeOfBoxesOrOfAFile) {
  const Scenario boxes = loaded(kTown + kHouse);
  EXPECT_EQ(boxes.world.ground_height_m(15, 15), 6.0);
  EXPECT_EQ(boxes.world.ground_height_m(5, 5), 0.0);
  EXPECT_EQ(boxes.material, "brick");
  const auto file = scratch_file("scenario_world_test.bt");
  boxes.world.save(file);
  EXPECT_EQ(loaded(kTown + "world: {octomap: " + file.string() + "}\n").world.hash(), boxes.world.hash());
  EXPECT_TRUE(loaded(kTown).world.is_flat());
}

TEST(ScenarioWorld, SourcesLieOnItsSurfaceAndBehindWallsWhereAsked) {
  const std::string yard =
      "world: {boxes: [{x_min_m: 10, x_max_m: 20, y_min_m: 10, y_max_m: 11, z_max_m: 4}, {x_min_m: 10, x_max_m: 11, "
      "y_min_m: 10, y_max_m: 20, z_max_m: 4}, {x_min_m: 10, x_max_m: 20, y_min_m: 19, y_max_m: 20, z_max_m: 4}]}\n";
  const Scenario scenario = loaded(
      kTown + yard + "sources: [{x_m: 10.4, y_m: 15, z_m: 0.5, activity_Bq: 1.0e8}]\n" +
      "sources_by_seed: {activities_Bq: [1.0e8, 1.0e8, 1.0e8], surface_max_m: 0.1, behind_walls: 2, height_m: 0.25}\n");
  int seen = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const std::vector<TrueSource> sources = draw_sources(scenario, seed);
    ASSERT_EQ(sources.size(), 4u);
    EXPECT_EQ(sources[0].p_W.z(), 4.5);
    for (std::size_t k = 1; k < 4; ++k) EXPECT_EQ(sources[k].p_W.z(), 0.25) << seed << ' ' << k;
    for (std::size_t k = 1; k < 3; ++k) {
      EXPECT_GE(hidden_share(scenario.world, sources[k].p_W), kBehindWalls) << seed << ' ' << k;
    }
    seen += hidden_share(scenario.world, sources[3].p_W) < kBehindWalls ? 1 : 0;
  }
  EXPECT_GT(seen, 5);
  EXPECT_EQ(hidden_share(World::flat(), {3, 3, 0}), 0.0);
}

TEST(ScenarioWorld, ObstaclesHoldPhotonsBackAsTheirMaterialDoes) {
  const Scenario scenario = idealised(loaded(
      kTown + "world: {boxes: [{x_min_m: 12, x_max_m: 12.25, y_min_m: 0, y_max_m: 30, z_max_m: 10}], voxel_m: 0.25}\n" +
      "sources: [{x_m: 15, y_m: 15, activity_Bq: 1.0e10}]\nbackground_singles_per_s: 0\n"));
  SimCamera camera = test_camera();
  const std::vector<Emitter> source = emitters(scenario.sources, {}, "Cs-137", camera.lines);
  const Eigen::Isometry3d X_WB(Eigen::Translation3d(9, 15, 0.5));  // six metres away, nearly level
  const auto photons = [&] {
    SimDetector detector(camera, scenario, source, 1, 1);
    for (int i = 0; i < 2000; ++i) (void)detector.step(X_WB, 0.01 * i, 0.01);
    return static_cast<double>(detector.photons());
  };
  const double all = photons();
  camera.obstacles = Shield::load("wood");
  const double some = photons();
  const double way_m = scenario.world.occupied_m(source[0].p_W, X_WB.translation() + Eigen::Vector3d(0, 0, -0.05));
  EXPECT_NEAR(way_m, 0.25, 0.01);
  const double share = std::exp(-way_m * Shield::load("wood").attenuation_per_m(source[0].energy_keV));
  EXPECT_LT(share, 0.4);
  EXPECT_NEAR(some / all, share, 4.0 * std::sqrt(1.0 / all + 1.0 / some));
  camera.obstacles = Shield::load("steel");
  EXPECT_LT(photons(), 0.01 * all);
}

TEST(ScenarioWorld, TheTeamExpectsOfObstaclesWhatTheyTakeOfItsNuclidesLine) {
  const std::filesystem::path tables = std::filesystem::path(COMPTONAUT_SOURCE_DIR) / "config/response";
  const Scenario scenario = loaded(kTown + kHouse);
  for (const auto& [table, line_keV] : {std::pair("cs-137.csv", 661.657), std::pair("co-60-1332.csv", 1332.492)}) {
    CoordinatorConfig coordinator{.response_table = tables / table};
    fit_to(scenario, coordinator);
    EXPECT_EQ(coordinator.obstacle_attenuation_per_m, Shield::load("brick").attenuation_per_m(line_keV)) << table;
  }
}

TEST(ScenarioWorld, ACollisionIsCountedOnceUntilItIsOver) {
  Scenario scenario = loaded(kTown + kHouse);
  const SimCamera camera = test_camera();
  SimWorld clear(camera, scenario, 1, 0);
  (void)clear.step();
  EXPECT_EQ(clear.collisions(), 0);
  scenario.mavs.height_m = 0.2;  // above the ground: it touches with 0.3 m
  SimWorld touching(camera, scenario, 1, 0);
  for (int i = 0; i < 50; ++i) (void)touching.step();
  EXPECT_EQ(touching.collisions(), 2);
}

TEST(ScenarioWorld, IsRefusedByFileLineAndKey) {
  const std::vector<std::pair<std::string, std::string>> wrong = {
      {"world: {material: brick}\n", "world.octomap: either the file of an octomap, a heightmap or boxes"},
      {"world: {octomap: /nowhere.bt}\n", "world.octomap: /nowhere.bt: cannot open"},
      {"world: {material: cheese, octomap: /nowhere.bt}\n", "world.material: 'cheese'"},
      {"world: {boxes: [{x_min_m: 2, x_max_m: 1}]}\n", "world.boxes[0].x_max_m"},
      {"world: {voxel_m: 0.05, boxes: [{x_min_m: 2, x_max_m: 3, y_min_m: 2, y_max_m: 3, z_max_m: 1}]}\n",
       "world.boxes: a map of 54 x 54 x 15.1 m has too many voxels"},
      {"world: {boxes: [{x_min_m: 0, x_max_m: 9, y_min_m: 0, y_max_m: 9, z_min_m: 3, z_max_m: 12}], ceiling_m: 13}\n",
       "mavs: MAV 1 would begin at (1, 1, 14), in an obstacle or in unknown space"}};
  for (const auto& [text, what] : wrong) {
    EXPECT_NE(refused(kTown + text).find(what), std::string::npos) << text << "says: " << refused(kTown + text);
  }
}

}  // namespace
}  // namespace comptonaut
