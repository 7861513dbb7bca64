// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/mlem_estimator.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "radiation/local_maxima.h"
#include "radiation/map_sources.h"
#include "radiation/toy_response.h"

namespace comptonaut {
namespace {

/// A cone with the source on its surface, its axis tilted by beta in a random plane.
Cone noiseless_cone(const Eigen::Vector3d& p_WS, const Eigen::Vector3d& source_W, Random& random) {
  const Eigen::Vector3d u_W = (source_W - p_WS).normalized();
  const double beta_rad = random.uniform(0.3, 1.5);
  const Eigen::Vector3d axis_W = Eigen::AngleAxisd(beta_rad, u_W.cross(random.unit_vector()).normalized()) * u_W;
  return {.p_WS = p_WS, .axis_W = axis_W, .cos_beta = std::cos(beta_rad)};
}

/// Sweeps the field in lanes; each viewpoint sees as many pairs as each source sends it on average, drawn by seed.
std::vector<MeasurementBatch> sweep(const std::vector<Eigen::Vector3d>& sources_W, double activity_Bq) {
  Random random(41);
  std::vector<MeasurementBatch> batches;
  for (double y_m = 1.0; y_m < 30.0; y_m += 2.0) {
    for (double x_m = 0.0; x_m < 30.0; x_m += 0.4) {
      MeasurementBatch batch{.live_us = 50'000, .p_WD = {x_m, y_m, 2.0}, .channels = {{.nuclide = "Cs-137"}}};
      batch.q_WD = Eigen::AngleAxisd(random.uniform(0, 6), Eigen::Vector3d::UnitZ());
      for (const Eigen::Vector3d& source_W : sources_W) {
        const Eigen::Vector3d to_source_W = source_W - batch.p_WD;
        const double expected = activity_Bq * 0.05 * toy_pair_response(batch.q_WD.conjugate() * to_source_W) *
                                std::exp(-0.0093 * to_source_W.norm()) / to_source_W.squaredNorm();
        for (auto n = random.poisson(expected); n > 0; --n) {
          batch.cones.push_back(noiseless_cone(batch.p_WD, source_W, random));
        }
      }
      batches.push_back(batch);
    }
  }
  return batches;
}

TEST(MlemEstimator, FindsKnownSourcesFromNoiselessConesWithinOneCell) {
  const Cells cells = flat_cells({0, 30, 0, 30}, 0.5);
  const std::vector<Eigen::Vector3d> sources_W{{7.25, 8.25, 0}, {21.75, 6.25, 0}, {14.25, 23.75, 0}};
  const double activity_Bq = 2e9;
  MlemEstimator estimator({.cone_sigma_rad = 0.08}, cells, "Cs-137", toy_pair_lookup);
  for (const MeasurementBatch& batch : sweep(sources_W, activity_Bq)) estimator.add(batch);
  estimator.update();
  const auto lambda = estimator.lambda_Bq();
  const auto found = sources_of_map(cells, lambda, local_maxima(cells, lambda), "Cs-137", 2.0);
  ASSERT_GE(found.size(), sources_W.size());
  for (const Eigen::Vector3d& source_W : sources_W) {
    double nearest_m = 1e9, activity = 0.0;
    for (std::size_t i = 0; i < sources_W.size(); ++i) {
      const double d_m = (found[i].p_W - source_W).norm();
      if (d_m < nearest_m) nearest_m = d_m, activity = found[i].activity_Bq;
    }
    EXPECT_LE(nearest_m, 0.71) << source_W.transpose();
    EXPECT_NEAR(activity / activity_Bq, 1.0, 0.4) << source_W.transpose();
  }
}

TEST(MlemEstimator, UsesItsNuclideAloneAndNoDeadTime) {
  const Cells cells = flat_cells({0, 10, 0, 10}, 0.5);
  MlemEstimator estimator({}, cells, "Cs-137", toy_pair_lookup);
  MeasurementBatch batch{.live_us = 0, .p_WD = {5, 5, 2}, .channels = {{.nuclide = "Co-60"}, {.nuclide = "Cs-137"}}};
  batch.cones = {{.channel = 0, .p_WS = {5, 5, 2}, .axis_W = {0, 0, -1}, .cos_beta = 0.9}};
  estimator.add(batch);
  EXPECT_EQ(estimator.rows(), 0);
  EXPECT_EQ(estimator.viewpoints(), 0);
  EXPECT_EQ(estimator.sensitivity_s()[0], 0.0);
  batch.cones[0].channel = 1;
  estimator.add(batch);
  EXPECT_EQ(estimator.rows(), 1);
  batch.cones[0].axis_W = {0, 0, 1};  // a narrow cone into the sky
  batch.cones[0].cos_beta = 1.0;
  estimator.add(batch);
  EXPECT_EQ(estimator.rows(), 1);
  EXPECT_EQ(estimator.cones_outside(), 1);
}

}  // namespace
}  // namespace comptonaut
