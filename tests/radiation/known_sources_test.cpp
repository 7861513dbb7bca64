// SPDX-License-Identifier: BSD-3-Clause
// What sources of another nuclide leave in a channel: they are fitted along, within what their own channel knows.
#include <gtest/gtest.h>

#include <cmath>

#include "radiation/joint_estimator.h"
#include "radiation/joint_world.h"

namespace comptonaut {
namespace {

/// Another nuclide leaves half as much per Bq as one of the channel's own.
ResponseTable half_table() {
  std::vector<ResponseEntry> entries = toy_table().entries();
  for (ResponseEntry& entry : entries) entry.single *= 0.5, entry.pair *= 0.5;
  return ResponseTable(std::move(entries));
}

JointPhysics physics_with_another() {
  JointPhysics physics = toy_physics();
  physics.of_others.push_back(toy_physics());
  physics.of_others[0].response = SmoothResponse(half_table());
  return physics;
}

const Cells& cells() {
  static const Cells shared = flat_cells({0, 30, 0, 30}, 0.5);
  return shared;
}

KnownSource known_at(double x_m, double y_m, double activity_Bq) {
  return {.other = 0,
          .source = {.p_W = {x_m, y_m, 0}, .activity_Bq = activity_Bq},
          .place_information = Eigen::Vector2d(25, 25).asDiagonal(),
          .activity_rel_sigma = 0.1};
}

std::vector<SourceEstimate> found(const ToyField& field, const std::vector<KnownSource>& known) {
  JointEstimator estimator({}, cells(), "Cs-137", physics_with_another());
  const auto batches = field.sweep(toy_physics(), 30.0, 2.0, 61);
  for (std::size_t i = 0; i < batches.size(); ++i) {
    estimator.add(batches[i]);
    if (i % 60 != 59) continue;
    estimator.set_known(known);
    estimator.update();
  }
  return estimator.sources();
}

/// In the channel a source of 2 GBq of the other nuclide looks as one of 1 GBq of its own.
const ToyField kOwnAndOther{
    .sources = {{.p_W = {8, 9, 0}, .activity_Bq = 1e9}, {.p_W = {22, 20, 0}, .activity_Bq = 1e9}}};

TEST(KnownSources, AreNoneOfTheChannelsOwn) {
  EXPECT_EQ(found(kOwnAndOther, {}).size(), 2U) << "else the test says nothing";
  const auto sources = found(kOwnAndOther, {known_at(22.2, 19.9, 2.15e9)});  // 1 sigma off everywhere
  ASSERT_EQ(sources.size(), 1U);
  EXPECT_LT((sources[0].p_W - kOwnAndOther.sources[0].p_W).norm(), 0.5);
  EXPECT_NEAR(sources[0].activity_Bq, 1e9, 0.15e9);
}

TEST(KnownSources, DoNotHideASourceTwoMetresBesideThem) {
  ToyField field = kOwnAndOther;
  field.sources[0].p_W = {20, 20, 0};
  const auto sources = found(field, {known_at(22, 20, 2e9)});
  ASSERT_EQ(sources.size(), 1U);
  EXPECT_LT((sources[0].p_W - field.sources[0].p_W).norm(), 0.5);
  EXPECT_NEAR(sources[0].activity_Bq, 1e9, 3.0 * sources[0].activity_sigma_Bq);
}

TEST(KnownSources, OfNothingThatIsThereComeToNothing) {
  const auto sources = found({.sources = {kOwnAndOther.sources[0]}}, {known_at(22, 20, 1e6)});
  ASSERT_EQ(sources.size(), 1U);
  EXPECT_LT((sources[0].p_W - kOwnAndOther.sources[0].p_W).norm(), 0.5);
}

/// Likelihood and gradient of a model with one known source and one own.
class KnownPrior : public ::testing::Test {
 protected:
  KnownPrior() {
    model = some_model(data);
    model.sources = {{.p_W = {6.4, 7.2, 0}, .activity_Bq = 3.2e9}, {.p_W = {14.5, 12.3, 0}, .activity_Bq = 1.1e9}};
    model.known = {known_at(6.2, 7.3, 4e9)};
  }
  [[nodiscard]] JointProblem problem() const { return {.config = config, .physics = physics, .data = data}; }

  JointConfig config;
  JointPhysics physics = physics_with_another();
  JointData data = some_data(9);
  JointModel model;
};

TEST_F(KnownPrior, IsGaussianInPlaceAndLogActivity) {
  JointModel own = model;
  own.known.clear();
  own.sources[0].activity_Bq *= 0.5;
  const double prior = -0.5 * (25 * (0.2 * 0.2 + 0.1 * 0.1) + std::pow(std::log(3.2 / 4.0) / 0.1, 2));
  EXPECT_NEAR(state_of(problem(), model).log_likelihood, state_of(problem(), own).log_likelihood + prior, 1e-6);
}

TEST_F(KnownPrior, ItsGradientIsThatOfFiniteDifferences) {
  const ParameterLayout layout{.sources = 2, .drones = 2, .movable = {0, 1}};
  const Linearisation at = linearise(problem(), state_of(problem(), model), layout);
  const auto expect = [&](std::size_t parameter, auto change) {
    JointModel up = model, down = model;
    change(up.sources[0], 1e-4);
    change(down.sources[0], -1e-4);
    const double difference = state_of(problem(), up).log_likelihood - state_of(problem(), down).log_likelihood;
    EXPECT_NEAR(at.gradient[parameter], difference / 2e-4, 2e-3 * std::abs(difference / 2e-4) + 0.05) << parameter;
  };
  expect(layout.log_activity(0), [](PointSource& source, double h) { source.activity_Bq *= std::exp(h); });
  expect(layout.x_m(0), [](PointSource& source, double h) { source.p_W.x() += h; });
  expect(layout.x_m(0) + 1, [](PointSource& source, double h) { source.p_W.y() += h; });
}

}  // namespace
}  // namespace comptonaut
