// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "radiation/joint_world.h"

namespace comptonaut {
namespace {

TEST(SmoothResponse, FollowsTheTableWithoutSteps) {
  const SmoothResponse smooth{toy_table()};
  Random random(3);
  for (int i = 0; i < 20'000; ++i) {
    const Eigen::Vector3d u_D = random.unit_vector();
    const Response L = smooth(7.0 * u_D.x(), 7.0 * u_D.y(), 7.0 * u_D.z());
    ASSERT_NEAR(L.pair / toy_pair_response(u_D), 1.0, 0.01) << u_D.transpose();
    const Eigen::Vector3d beside_D = (u_D + 1e-4 * random.unit_vector()).normalized();
    const Response near = smooth(beside_D.x(), beside_D.y(), beside_D.z());
    ASSERT_NEAR(near.single / L.single, 1.0, 2e-4) << u_D.transpose();
    ASSERT_NEAR(near.pair / L.pair, 1.0, 2e-4) << u_D.transpose();
  }
}

TEST(ConeTable, FollowsTheDensityItIsMadeOf) {
  const ConeTable table(toy_cones(), 0.02);
  Random random(4);
  for (int i = 0; i < 20'000; ++i) {
    const double beta_rad = random.uniform(0.0, M_PI), alpha_rad = random.uniform(0.0, M_PI);
    const Readings readings = i % 2 == 0 ? Readings::kBoth : Readings::kSole;
    const ConeProfile profile = toy_cones().profile(std::cos(beta_rad), readings, 0.02);
    const double exact = profile.per_sr(std::cos(alpha_rad));
    const double allowed = std::sin(beta_rad) >= 0.5 ? 0.03 : std::sin(beta_rad) >= 0.2 ? 0.08 : 0.12;
    ASSERT_NEAR(table.per_sr(readings, beta_rad, std::cos(alpha_rad)), exact, allowed * exact + 1e-3)
        << "beta " << beta_rad << " alpha " << alpha_rad;
  }
  for (const double x : {-1.0, -0.999, -0.3, 0.0, 0.4, 0.9999, 1.0}) EXPECT_NEAR(quick_acos(x), std::acos(x), 3e-8);
}

/// Section 5.4, word for word.
TEST(ResponseColumn, IsWhatTheDesignSays) {
  const JointPhysics physics = toy_physics();
  const ToyField field{.sources = {{.p_W = {7, 8, 0}, .activity_Bq = 2e9}}};
  const auto batches = field.sweep(physics, 15.0, 2.0, 5);
  const JointData data = data_of(batches);
  ASSERT_GT(data.pairs.size(), 10U);
  const Eigen::Vector3d m_W(6.1, 8.7, 0.2);
  ResponseColumn column;
  fill_column(physics, data, m_W, column);
  std::vector<double> exposure_s(2, 0.0);
  std::size_t i = 0;
  for (std::size_t v = 0; v < batches.size(); ++v) {
    const MeasurementBatch& batch = batches[v];
    const Eigen::Vector3d to_W = m_W - batch.p_WD, u_D = batch.q_WD.conjugate() * to_W;
    const Response L = physics.response(u_D.x(), u_D.y(), u_D.z());
    const double geometry = std::exp(-0.0093 * to_W.norm()) / to_W.squaredNorm();
    ASSERT_NEAR(column.singles[v] / (0.05 * L.single * geometry), 1.0, 1e-8) << v;
    exposure_s[batch.key.sender - 1] += 0.05 * L.pair * geometry;
    for (std::size_t c = 0; c < batch.cones.size(); c += 2, ++i) {
      double sum = 0.0;
      for (const Cone& cone : {batch.cones[c], batch.cones[c + 1]}) {
        const double cos_alpha = to_W.normalized().dot(cone.axis_W);
        sum += cone.weight * toy_cones().profile(cone.cos_beta, Readings::kBoth, 0.01).per_sr(cos_alpha);
      }
      ASSERT_NEAR(column.pairs[i] / (L.pair * geometry * sum), 1.0, 0.03) << i;
    }
  }
  EXPECT_EQ(i, data.pairs.size());
  EXPECT_NEAR(column.exposure_s[0] / exposure_s[0], 1.0, 1e-8);
  EXPECT_NEAR(column.exposure_s[1] / exposure_s[1], 1.0, 1e-8);
}

/// Pairs are looked at several at once: with one reading and with two, and some left over at the end.
TEST(ResponseColumn, IsWhatEachPairSaysAlone) {
  constexpr double kRounding = 1e-12;
  const JointPhysics physics = toy_physics();
  const ToyField field{.sources = {{.p_W = {7, 8, 0}, .activity_Bq = 2e10}}};
  JointData data = data_of(field.sweep(physics, 15.0, 2.0, 6));
  ASSERT_GT(data.pairs.size(), 100U);
  for (std::size_t i = 0; i < data.pairs.size(); i += 3) {
    data.pairs[i].hypotheses.resize(1);
    data.pairs[i].readings = Readings::kSole;
  }
  const Eigen::Vector3d m_W(6.1, 8.7, 0.2);
  ResponseColumn column;
  fill_column(physics, data, m_W, column);
  for (std::size_t i = 0; i < data.pairs.size(); ++i) {
    ASSERT_NEAR(column.pairs[i] / pair_density(physics, data.pairs[i], m_W), 1.0, kRounding) << "pair " << i;
  }
}

TEST(ResponseColumn, IsBoundedOnTheAxisAtTheDetectorAndBelowGround) {
  const JointPhysics physics = toy_physics();
  MeasurementBatch batch{.live_us = 50'000, .p_WD = {5, 5, 2}, .channels = {{.nuclide = "Cs-137"}}};
  batch.cones = {{.p_WS = {5, 5, 2}, .axis_W = {0, 0, -1}, .cos_beta = 1.0, .weight = 1.0}};
  const JointData data = data_of({batch});
  for (const double z_m : {2.0, 1.999, 0.0, -50.0}) {
    ResponseColumn column;
    fill_column(physics, data, {5, 5, z_m}, column);
    for (const double value : {column.singles[0], column.pairs[0], column.exposure_s[0]}) {
      EXPECT_TRUE(std::isfinite(value) && value > 0.0) << z_m;
    }
  }
}

TEST(JointData, KeepsItsNuclideAndNoDeadTime) {
  MeasurementBatch batch{.live_us = 0, .channels = {{.nuclide = "Co-60", .singles = 5}, {.nuclide = "Cs-137"}}};
  batch.channels[1].singles = 7;
  batch.cones = {{.event = 0, .channel = 0, .weight = 1.0},
                 {.event = 1, .channel = 1, .weight = 0.3},
                 {.event = 1, .channel = 1, .weight = 0.7},
                 {.event = 2, .channel = 1, .weight = 0.0}};
  JointData data;
  add(data, batch, "Cs-137");
  EXPECT_EQ(data.viewpoints.size(), 0U) << "no live time";
  ASSERT_EQ(data.pairs.size(), 1U);
  EXPECT_EQ(data.pairs[0].hypotheses.size(), 2U);
  batch.live_us = 40'000;
  add(data, batch, "Cs-137");
  ASSERT_EQ(data.viewpoints.size(), 1U);
  EXPECT_EQ(data.viewpoints.singles[0], 7.0);
  EXPECT_EQ(data.live_s[0], 0.04);
}

}  // namespace
}  // namespace comptonaut
