// SPDX-License-Identifier: BSD-3-Clause
// What stands between sources and detectors, in all that the estimators compute: against the same without obstacles,
// each ray weakened by itself. Viewpoints stand in the middle of their blocks of air, where blocks are exact.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "radiation/joint_estimator.h"
#include "radiation/joint_world.h"
#include "radiation/map_rows.h"
#include "radiation/mlem_estimator.h"
#include "radiation/sight_lines.h"

namespace comptonaut {
namespace {

constexpr double kWallPer_m = 1.2;

/// A house and a wall on 20 x 20 m.
World walled() {
  return World::of_boxes(std::vector<Box>{{{8, 8, 0}, {11, 12, 3}}, {{3, 4, 0}, {15, 4.5, 4}}},
                         {{-5, -5, -1}, {25, 25, 10}}, 0.5);
}

/// Made once: the response's map takes its time.
const JointPhysics& physics_behind_walls() {
  static const JointPhysics shared = [] {
    JointPhysics physics = toy_physics();
    physics.obstacles_per_m = kWallPer_m;
    return physics;
  }();
  return shared;
}

/// Of a source, each in the middle of a block.
const std::vector<MeasurementBatch>& some_batches() {
  static const std::vector<MeasurementBatch> shared = [] {
    const ToyField toy{.sources = {{.p_W = {6.2, 7.3, 0.0}, .activity_Bq = 4e9}}};
    Random random(5);
    std::vector<MeasurementBatch> batches;
    for (double x_m = 0.5; x_m < 20.0; x_m += 3.0) {
      for (double y_m = 0.5; y_m < 20.0; y_m += 4.0) {
        batches.push_back(toy.measure(physics_behind_walls(), 1, {x_m, y_m, 2.5}, random));
      }
    }
    return batches;
  }();
  return shared;
}

TEST(Obstacles, WeakenAColumnRayByRay) {
  const World world = walled();
  const JointPhysics& physics = physics_behind_walls();
  JointData open = data_of(some_batches()), behind = open;
  behind.sight = std::make_shared<SightLines>(world);
  const Eigen::Vector3d p_W(7.0, 9.5, 0.0);  // a corner of the lattice
  ResponseColumn without, with;
  fill_column(physics, open, p_W, without);
  fill_column(physics, behind, p_W, with);
  double exposure_s = 0.0;
  int shadowed = 0;
  for (std::size_t v = 0; v < with.singles.size(); ++v) {
    const Viewpoints& at = open.viewpoints;
    const double share = let_through(world, kWallPer_m, p_W, {at.x_m[v], at.y_m[v], at.z_m[v]});
    EXPECT_NEAR(with.singles[v], share * without.singles[v], 1e-6 * without.singles[v]) << v;
    shadowed += share < 0.5 ? 1 : 0;
    JointData one = data_of({some_batches()[v]});
    ResponseColumn alone;
    fill_column(physics, one, p_W, alone);
    exposure_s += share * alone.exposure_s[0];
  }
  EXPECT_GT(shadowed, 5);
  EXPECT_LT(shadowed, 30);
  EXPECT_NEAR(with.exposure_s[0], exposure_s, 1e-6 * exposure_s);
  ASSERT_GE(with.pairs.size(), 3u);
  for (std::size_t i = 0; i < with.pairs.size(); ++i) {
    const double share = let_through(world, kWallPer_m, p_W, open.pairs[i].p_WS);
    EXPECT_NEAR(with.pairs[i], share * without.pairs[i], 1e-6 * without.pairs[i]) << i;
  }
}

TEST(Obstacles, WeakenTheMapsRowsNodeByNode) {
  const World world = walled();
  const Cells cells = world.surface_cells({0, 20, 0, 20}, 0.5);
  const JointPhysics& physics = physics_behind_walls();
  JointData open = data_of({some_batches()[10]}), behind = open;
  behind.sight = std::make_shared<SightLines>(world);
  MapRows without(cells, {}), with(cells, {});
  without.extend(physics, open);
  with.extend(physics, behind);
  const Eigen::Vector3d eye_W = some_batches()[10].p_WD;
  const GroundTree& tree = with.tree();
  const std::vector<std::uint32_t>& nodes = with.blocks()[0].nodes;
  int shadowed = 0;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const GroundNode& node = tree.nodes()[nodes[k]];
    double mean = 0.0;
    for (const std::uint32_t cell : tree.cells_of(node)) {
      mean += let_through(world, kWallPer_m, cells.p_W(cell), eye_W) / node.cells;
    }
    const double share = with.singles_s()[0][nodes[k]].value / without.singles_s()[0][nodes[k]].value;
    EXPECT_NEAR(share, mean, node.cells == 1 ? 1e-5 : 0.5) << node.p_W.transpose();  // of many cells, four are asked
    EXPECT_NEAR(with.pairs_s()[0][nodes[k]].value / without.pairs_s()[0][nodes[k]].value, share, 1e-5);
    shadowed += mean < 0.5 ? 1 : 0;
  }
  EXPECT_GT(shadowed, 20);
}

TEST(Obstacles, WeakenWhatMlemSeesCellByCell) {
  const World world = walled();
  const Cells cells = world.surface_cells({0, 20, 0, 20}, 0.5);
  MlemEstimator open({}, cells, "Cs-137", toy_pair_lookup);
  MlemEstimator behind({}, cells, "Cs-137", toy_pair_lookup, world, kWallPer_m);
  const MeasurementBatch batch = some_batches()[10];
  open.add(batch);
  behind.add(batch);
  int shadowed = 0;
  for (std::size_t j = 0; j < cells.size(); ++j) {
    const double share = let_through(world, kWallPer_m, cells.p_W(j), batch.p_WD);
    EXPECT_NEAR(behind.sensitivity_s()[j], share * open.sensitivity_s()[j], 1e-6 * open.sensitivity_s()[j]) << j;
    shadowed += share < 0.5 ? 1 : 0;
  }
  EXPECT_GT(shadowed, 100);
}

/// Sees walls as the likelihood believes them: singles of a source behind a wall are few.
TEST(Obstacles, ASourceBehindAWallIsFoundWhereItIsAndAsStrongAsItIs) {
  const World world = walled();
  const Cells cells = world.surface_cells({0, 20, 0, 20}, 0.5);
  const JointPhysics& physics = physics_behind_walls();
  const PointSource truth{.p_W = {9.0, 5.25, 0.0}, .activity_Bq = 4e9};
  Random random(11);
  JointEstimator knows({}, cells, "Cs-137", physics, world), blind({}, cells, "Cs-137", physics);
  for (double y_m = 0.5; y_m < 20.0; y_m += 2.0) {
    for (double x_m = 0.1; x_m < 20.0; x_m += 0.4) {
      const Eigen::Vector3d p_WD(x_m, y_m, 5.5);
      const double share = let_through(world, kWallPer_m, truth.p_W, p_WD);
      const ToyField toy{.sources = {{.p_W = truth.p_W, .activity_Bq = share * truth.activity_Bq}}};
      const MeasurementBatch batch = toy.measure(physics, 1, p_WD, random);
      knows.add(batch);
      blind.add(batch);
    }
  }
  knows.update();
  blind.update();
  ASSERT_EQ(knows.sources().size(), 1u);
  EXPECT_LT((knows.sources()[0].p_W - truth.p_W).norm(), 0.3) << knows.sources()[0].p_W.transpose();
  EXPECT_NEAR(knows.sources()[0].activity_Bq / truth.activity_Bq, 1.0, 0.1);
  EXPECT_GT(knows.log_likelihood(), blind.log_likelihood() + 5.0);
}

}  // namespace
}  // namespace comptonaut
