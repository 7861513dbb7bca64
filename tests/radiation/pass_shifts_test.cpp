// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/pass_shifts.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>

#include "radiation/joint_fit.h"
#include "radiation/joint_world.h"

namespace comptonaut {
namespace {

/// One source, swept by two drones.
class PassShifts : public ::testing::Test {
 protected:
  PassShifts() {
    spread_over_time(40);
    model = {.sources = field.sources, .drones = std::vector<DroneModel>(2)};
    state = state_of(problem(), model);
    refit(problem(), kGround, {0}, 30, 1e-6, state);
  }
  [[nodiscard]] JointProblem problem() const { return {.config = config, .physics = physics, .data = data}; }

  /// A pass is so many batches.
  void spread_over_time(std::size_t per_pass) {
    for (std::size_t i = 0; i < batches.size(); ++i) {
      batches[i].utime = kSecond_us + microseconds(config.pass_s) * static_cast<Utime>(i / per_pass);
    }
    data = data_of(batches);
  }

  /// Of x, y of the source with all else as it is.
  [[nodiscard]] Eigen::Matrix2d place_information() const {
    const ParameterLayout layout{.sources = 1, .drones = 2, .movable = {0}};
    const auto x = static_cast<Eigen::Index>(layout.x_m(0));
    return linearise(problem(), state, layout).information.block<2, 2>(x, x);
  }
  [[nodiscard]] Eigen::Matrix2d shifts() const {
    return pass_shifts(problem(), state, {place_information().inverse()})[0];
  }

  const Ground kGround{.area = {0, 12, 0, 12}, .z_m = [](double, double) { return 0.0; }};
  JointConfig config;
  JointPhysics physics = toy_physics();
  ToyField field{.sources = {{.p_W = {5, 6, 0}, .activity_Bq = 2e9}}};
  std::vector<MeasurementBatch> batches = field.sweep(physics, 12.0, 2.0, 7);
  JointData data;
  JointModel model;
  JointState state;
};

TEST_F(PassShifts, AreNoneWithoutErrorsOfThePoses) {
  config.pass_sigma_m = 0.0;
  EXPECT_EQ(shifts().norm(), 0.0);
}

/// A drone that is off by d all the time takes the source with it by d.
TEST_F(PassShifts, OfOneLongPassAreTheShiftOfThePose) {
  for (MeasurementBatch& batch : batches) batch.key.sender = 1;
  config.pass_s = 3600.0;
  data = data_of(batches);
  model.drones.resize(1);
  state = state_of(problem(), model);
  const ParameterLayout layout{.sources = 1, .drones = 1, .movable = {0}};
  const auto x = static_cast<Eigen::Index>(layout.x_m(0));
  const Eigen::Matrix2d information = linearise(problem(), state, layout).information.block<2, 2>(x, x);
  const Eigen::Matrix2d shift = pass_shifts(problem(), state, {information.inverse()})[0];
  const double variance_m2 = config.pass_sigma_m * config.pass_sigma_m;
  EXPECT_LT((shift - variance_m2 * Eigen::Matrix2d::Identity()).norm(), 1e-6 * variance_m2);
}

/// The oracle: what a pass tells is the information of all data less that of the data without it.
TEST_F(PassShifts, AreWhatEachPassTellsTakenFromTheDataWithoutIt) {
  const Eigen::Matrix2d covariance = place_information().inverse();
  const ParameterLayout layout{.sources = 1, .drones = 2, .movable = {0}};
  const auto pass_of = [&](int drone, Utime utime) { return std::pair(drone, utime / microseconds(config.pass_s)); };
  std::set<std::pair<int, std::int64_t>> passes;
  for (std::size_t v = 0; v < data.viewpoints.size(); ++v) {
    passes.insert(pass_of(data.viewpoints.drone[v], data.viewpoints.utime[v]));
  }
  ASSERT_GT(passes.size(), 4U);
  Eigen::Matrix2d slow = Eigen::Matrix2d::Zero();
  for (const auto& pass : passes) {
    JointData without;
    std::vector<MeasurementBatch> rest;
    for (const MeasurementBatch& batch : batches) {
      if (pass_of(batch.key.sender - 1, batch.utime) != pass) rest.push_back(batch);
    }
    without = data_of(rest);
    const JointProblem others{.config = config, .physics = physics, .data = without};
    JointModel same = state.model;
    const auto x = static_cast<Eigen::Index>(layout.x_m(0));
    const Eigen::Matrix2d left = linearise(others, state_of(others, same), layout).information.block<2, 2>(x, x);
    for (int axis = 0; axis < 2; ++axis) {
      const Eigen::Vector2d d_m = config.pass_sigma_m * Eigen::Vector2d::Unit(axis);
      const Eigen::Vector2d moved_m = covariance * (place_information() - left) * d_m;
      slow += moved_m * moved_m.transpose();
    }
  }
  EXPECT_LT((shifts() - slow).norm(), 1e-6 * slow.norm());
}

TEST_F(PassShifts, OfMorePassesAreSmaller) {
  spread_over_time(5);
  const double many = shifts().trace();
  spread_over_time(160);
  const double few = shifts().trace();
  EXPECT_LT(many, 0.7 * few);
  const double variance_m2 = config.pass_sigma_m * config.pass_sigma_m;
  EXPECT_LE(few, 2.0 * variance_m2 * (1.0 + 1e-9)) << "no more than if all were one";
}

TEST_F(PassShifts, GrowWithTheSquareOfTheErrorAndCountWhatIsUsedOnly) {
  const Eigen::Matrix2d once = shifts();
  config.pass_sigma_m *= 2.0;
  EXPECT_LT((shifts() - 4.0 * once).norm(), 1e-9 * once.norm());
  config.use_singles = config.use_pairs = false;
  EXPECT_EQ(pass_shifts(problem(), state, {Eigen::Matrix2d::Identity()})[0].norm(), 0.0);
}

}  // namespace
}  // namespace comptonaut
