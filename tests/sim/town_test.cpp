// SPDX-License-Identifier: BSD-3-Clause
#include "sim/town.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "scratch.h"
#include "sim/fit.h"
#include "sim/scenario.h"

namespace comptonaut {
namespace {

TEST(Town, HasStreetsAndRoomForTheStartsAndTwoSourcesBehindWalls) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const TownPlan plan{.seed = seed};
    for (const Box& box : town_boxes(plan)) {
      EXPECT_GE(box.min_W.x(), 2.0);
      EXPECT_GE(box.min_W.y(), 6.0);
      EXPECT_LE(box.max_W.x(), plan.x_m - 2.0);
      EXPECT_LE(box.max_W.z(), plan.z_m - 5.0);
      const Eigen::Vector3d halves = 2.0 * box.max_W;
      EXPECT_EQ(halves, Eigen::Vector3d(halves.array().round()));
    }
    const Scenario scenario = load_scenario(scratch_file("town_test.yaml", town_yaml(plan, "town")));
    for (std::uint64_t layout = 1; layout <= 5; ++layout) {
      const std::vector<TrueSource> sources = draw_sources(scenario, layout);
      ASSERT_EQ(sources.size(), 4u);
      for (std::size_t k = 0; k < 2; ++k) {
        EXPECT_GE(hidden_share(scenario.world, sources[k].p_W), kBehindWalls) << seed << ' ' << layout;
      }
    }
  }
}

TEST(Town, IsTheSameForTheSameSeedAndAnotherForAnother) {
  EXPECT_EQ(town_yaml({.seed = 3}, "a"), town_yaml({.seed = 3}, "a"));
  EXPECT_NE(town_yaml({.seed = 3}, "a"), town_yaml({.seed = 4}, "a"));
}

TEST(Town, LetsAMavWithoutPlansReturnAboveItsRoofs) {
  const TownPlan plan{.seed = 3};
  PoseBridgeConfig bridge;
  fit_to(load_scenario(scratch_file("town_return.yaml", town_yaml(plan, "town"))), bridge);
  for (const Box& box : town_boxes(plan)) EXPECT_GE(bridge.pilot.return_z_m, box.max_W.z() + 1.0);
  EXPECT_LE(bridge.pilot.return_z_m, plan.z_m);
}

TEST(Town, RefusesWhatCannotBeBuilt) {
  EXPECT_THROW((void)town_boxes({.x_m = 10}), std::invalid_argument);
  EXPECT_THROW((void)town_boxes({.z_m = 4}), std::invalid_argument);
  EXPECT_THROW((void)town_boxes({.buildings = 0}), std::invalid_argument);
  EXPECT_THROW((void)town_boxes({.sources = 0}), std::invalid_argument);
  EXPECT_THROW((void)town_boxes({.drones = 16}), std::invalid_argument);
  EXPECT_THROW((void)town_boxes({.x_m = 30, .drones = 12}), std::invalid_argument);
  EXPECT_THROW((void)town_boxes({.x_m = 30, .y_m = 30, .buildings = 60}), std::runtime_error);
}

}  // namespace
}  // namespace comptonaut
