// SPDX-License-Identifier: BSD-3-Clause
// Maps of obstacles are right to a voxel at best.
#include "radiation/sure_loss.h"

#include <gtest/gtest.h>

#include <memory>

#include "radiation/joint_estimator.h"
#include "radiation/joint_world.h"
#include "radiation/sight_lines.h"

namespace comptonaut {
namespace {

constexpr double kConcretePer_m = 10.0;

/// 20 x 20 m with a wall across that is so high.
World with_wall(double height_m) {
  return World::of_boxes(std::vector<Box>{{{10, -5, 0}, {10.5, 25, height_m}}}, {{-5, -5, -1}, {25, 25, 10}}, 0.5);
}

const JointPhysics& concrete_physics() {
  static const JointPhysics shared = [] {
    JointPhysics physics = toy_physics();
    physics.obstacles_per_m = kConcretePer_m;
    return physics;
  }();
  return shared;
}

/// What one MAV measures that flies to and fro over the wall, 5 m high.
std::vector<MeasurementBatch> swept(const World& world, const std::vector<PointSource>& sources) {
  Random random(7);
  std::vector<MeasurementBatch> batches;
  for (double y_m = 0.5; y_m < 20.0; y_m += 1.0) {
    for (double x_m = 0.1; x_m < 20.0; x_m += 0.2) {
      const Eigen::Vector3d p_WD(x_m, y_m, 5.0);
      ToyField toy;
      for (const PointSource& source : sources) {
        const double share = let_through(world, kConcretePer_m, source.p_W, p_WD);
        toy.sources.push_back({.p_W = source.p_W, .activity_Bq = share * source.activity_Bq});
      }
      batches.push_back(toy.measure(concrete_physics(), 1, p_WD, random));
    }
  }
  return batches;
}

JointEstimator estimated(const World& map, const std::vector<MeasurementBatch>& batches) {
  const Cells cells = map.surface_cells({0, 20, 0, 20}, 0.5);  // has to live as long as there are updates
  JointEstimator estimator({}, cells, "Cs-137", concrete_physics(), map);
  for (const MeasurementBatch& batch : batches) estimator.add(batch);
  for (int update = 0; update < 3; ++update) estimator.update();
  return estimator;
}

TEST(SureLoss, IsTheWholeLossOfASourceThatIsAlone) {
  const World world = with_wall(3.0);
  const PointSource source{.p_W = {16, 10, 0}, .activity_Bq = 2e10};
  JointData data = data_of(swept(world, {source}));
  data.sight = std::make_shared<SightLines>(world);
  const JointConfig config;
  const JointProblem problem{.config = config, .physics = concrete_physics(), .data = data};
  JointModel model{.sources = {source}, .drones = {DroneModel{.singles_per_s = 3.0, .pairs_per_s = 0.1}}};
  const JointState state = state_of(problem, model);
  model.sources[0].activity_Bq = 0.0;
  const double loss = state.log_likelihood - log_likelihood(problem, model, state.columns);
  EXPECT_GT(loss, 100.0);
  EXPECT_NEAR(sure_loss(problem, state, 0), loss, 1e-6 * loss);
}

// What shines over the wall's true edge, sources at its foot or far off explain as well.
TEST(SureLoss, AWallThatIsAVoxelTooHighFeignsNoSource) {
  const PointSource source{.p_W = {16, 10, 0}, .activity_Bq = 2e10};
  const JointEstimator estimator = estimated(with_wall(3.5), swept(with_wall(3.0), {source}));
  ASSERT_EQ(estimator.sources().size(), 1u);
  EXPECT_LT((estimator.sources()[0].p_W - source.p_W).norm(), 1.0);
  EXPECT_GE(estimator.doubtful(), 1) << "else this test shows nothing";
  EXPECT_EQ(estimator.points().size(), 1u + static_cast<std::size_t>(estimator.doubtful()));
}

TEST(SureLoss, AWeakSourceAtTheFootOfAWallIsStillTold) {
  const World world = with_wall(3.0);
  const JointEstimator estimator = estimated(
      world, swept(world, {{.p_W = {16, 10, 0}, .activity_Bq = 2e10}, {.p_W = {9.25, 6, 0}, .activity_Bq = 2e9}}));
  ASSERT_EQ(estimator.sources().size(), 2u);
  EXPECT_LT((estimator.sources()[1].p_W - Eigen::Vector3d(9.25, 6, 0)).norm(), 1.0);
  EXPECT_EQ(estimator.doubtful(), 0);
}

}  // namespace
}  // namespace comptonaut
