// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/coordinator_config.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>

#include "config/config.h"
#include "nodes/coordinator_fixture.h"
#include "nodes/dispatch_fixture.h"
#include "nodes/mapper_config.h"
#include "nodes/plan_of.h"
#include "scratch.h"

namespace comptonaut {
namespace {

TEST(CoordinatorConfig, ShipsForDronesAndForAGroundLaptop) {
  for (const std::string name : {"coordinator.yaml", "coordinator-ground.yaml"}) {
    const auto file = std::filesystem::path(COMPTONAUT_SOURCE_DIR) / "config" / name;
    const CoordinatorConfig config = load_config(file, read_coordinator_config);
    EXPECT_EQ(config.mavs, (std::vector<int>{1, 2, 3})) << name;
    EXPECT_EQ(config.response_table.filename(), "cs-137.csv") << name;
    EXPECT_EQ(config.estimator, "joint") << name;
  }
}

/// Whoever leads must come to the same plans.
TEST(CoordinatorConfig, SaysTheSameToDronesAndToAGroundLaptop) {
  const auto said = [](const char* name) {
    std::ifstream file(std::filesystem::path(COMPTONAUT_SOURCE_DIR) / "config" / name);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    return text.substr(text.find("\nmission:"));
  };
  EXPECT_EQ(said("coordinator.yaml"), said("coordinator-ground.yaml"));
}

TEST(CoordinatorConfig, RefusesNonsenseInOneLine) {
  const std::string good = "mission: 1\nresponse_table: t.csv\n";
  EXPECT_EQ(
      parse_config(good + "area: {x_min_m: 0, x_max_m: 9, y_min_m: 0, y_max_m: 8}", "a.yaml", read_coordinator_config)
          .area,
      (Area{0, 9, 0, 8}));
  for (const std::string bad :
       {"mavs: []", "mavs: [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16]", "plan_waypoints_max: 17",
        "mavs: [1, 1]", "mavs: [0]", "estimator: guess", "cell_m: -1", "x: 1",
        "area: {x_min_m: 9, x_max_m: 0, y_min_m: 0, y_max_m: 8}", "mlem: {iterations: 0}", "joint: {use: [pears]}",
        "joint: {use: []}", "joint: {gain_to_add: 10, loss_to_drop: 12}"}) {
    EXPECT_THROW((void)parse_config(good + bad, "a.yaml", read_coordinator_config), ConfigError) << bad;
  }
  EXPECT_THROW((void)parse_config("mission: 1", "a.yaml", read_coordinator_config), ConfigError);
}

TEST(CoordinatorConfig, RefusesAFenceWhoseEdgesCrossOrThatIsNone) {
  const auto read = [](const std::string& corners) {
    const std::string text = "mission: 1\nresponse_table: t.csv\nfence:\n  corners: [" + corners + "]\n";
    return parse_config(text, "a.yaml", read_coordinator_config);
  };
  const auto said = [&](const std::string& corners) -> std::string {
    try {
      (void)read(corners);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "accepted";
  };
  const std::string a = "{x_m: 0, y_m: 0}", b = "{x_m: 9, y_m: 0}", c = "{x_m: 9, y_m: 9}", d = "{x_m: 0, y_m: 9}";
  const std::string crossing = "a.yaml:4: fence.corners: the fence's edges cross or touch, must be in order round it";
  EXPECT_EQ(fence_of(read(a + ", " + b + ", " + c + ", " + d)).border, (Polygon{{0, 0}, {9, 0}, {9, 9}, {0, 9}}));
  EXPECT_EQ(said(a + ", " + c + ", " + b + ", " + d), crossing);
  EXPECT_EQ(said(a + ", " + b + ", " + c + ", " + b), crossing) << "back the way that it came";
  EXPECT_EQ(said(a + ", " + c), "a.yaml:4: fence.corners: 2 are not enough, must be 3 at least");
}

CoordinatorConfig cutting_corners_by(const std::string& deviation_m) {
  return parse_config(
      "mission: 1\nresponse_table: t.csv\narea: {x_min_m: 0, x_max_m: 12, y_min_m: 0, y_max_m: 12}\n"
      "search: {strategy: zigzag}\ncorner_deviation_max_m: " +
          deviation_m,
      "a.yaml", read_coordinator_config);
}

/// A MAV that may cut corners by more passes the same waypoints earlier.
TEST(CoordinatorConfig, SearchAndFlightCutCornersByWhatItSays) {
  for (const std::string deviation_m : {"0.05", "0.8"}) {
    const SearchFacts facts = search_facts(cutting_corners_by(deviation_m), toy_table(), {});
    EXPECT_EQ(facts.corner_deviation_max_m, std::stod(deviation_m));
  }
  const auto plan_of = [](const std::string& deviation_m) {
    Team team{.config = cutting_corners_by(deviation_m)};
    team.places_W = {{1, {1, 1, 2}}};
    return team.tick().front();
  };
  const Plan sharp = plan_of("0.05"), round = plan_of("0.8");
  constexpr std::size_t kCorner = 2;
  ASSERT_GT(std::min(sharp.waypoints.size(), round.waypoints.size()), kCorner) << sharp.status;
  EXPECT_EQ(sharp.waypoints[kCorner].p_W, round.waypoints[kCorner].p_W);
  EXPECT_LT(seconds(round.waypoints[kCorner].utime - sharp.waypoints[kCorner].utime), -0.5);
}

TEST(CoordinatorConfig, OpensUnknownSpaceWhereItSaysSo) {
  const Eigen::Vector3d hole_W(5, 5, 3);
  const auto map = scratch_file("hole.bt");
  World::of_voxels({{-2, -2, -1}, {12, 12, 6}}, 0.5, [&](const Eigen::Vector3d& p_W) {
    if ((p_W - hole_W).norm() < 2.0) return Occupancy::kUnknown;
    return p_W.z() < 0.0 ? Occupancy::kOccupied : Occupancy::kFree;
  }).save(map);
  const auto closed = [&](const std::string& unknown_space) {
    const std::string text = "mission: 1\noctomap: " + map.string() + "\n" + unknown_space;
    const auto mapper = parse_config(text + "journal_dir: j\n", "m.yaml", read_mapper_config);
    const auto coordinator = parse_config(text + "response_table: t.csv\n", "c.yaml", read_coordinator_config);
    const World world = load_world(coordinator.terrain);
    EXPECT_FALSE(world.closed(Eigen::Vector3d(1, 1, 3)));
    EXPECT_TRUE(world.closed(Eigen::Vector3d(1, 1, -0.3)));
    EXPECT_EQ(load_world(mapper.terrain).closed(hole_W), world.closed(hole_W)) << unknown_space;
    return world.closed(hole_W);
  };
  EXPECT_TRUE(closed(""));
  EXPECT_TRUE(closed("unknown_space: closed\n"));
  EXPECT_FALSE(closed("unknown_space: free\n"));
}

}  // namespace
}  // namespace comptonaut
