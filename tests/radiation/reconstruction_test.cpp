// SPDX-License-Identifier: BSD-3-Clause
// What a recording as a whole says; and that whatever stands in it, the answer is defined.
#include "radiation/reconstruction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "radiation/joint_world.h"

namespace comptonaut {
namespace {

constexpr double kEdge_m = 16.0;

Cells field_cells() { return flat_cells({0, kEdge_m, 0, kEdge_m}, 0.5); }

std::vector<MeasurementBatch> field_batches() {
  const ToyField field{.sources = {{{4.3, 5.2, 0.0}, 2e9}, {{11.6, 10.1, 0.0}, 4e9}}};
  return field.sweep(toy_physics(), kEdge_m, 2.0, 7);
}

Reconstruction answer(const std::string& estimator, const std::vector<MeasurementBatch>& batches) {
  return reconstruct({.estimator = estimator}, field_cells(), toy_table(), toy_cones(), batches);
}

void expect_finite(const Reconstruction& result, const std::string& what) {
  ASSERT_EQ(result.lambda_Bq.size(), field_cells().size()) << what;
  for (std::size_t j = 0; j < result.lambda_Bq.size(); ++j) {
    ASSERT_TRUE(std::isfinite(result.lambda_Bq[j]) && result.lambda_Bq[j] >= 0.0) << what << ", cell " << j;
    ASSERT_TRUE(std::isfinite(result.sensitivity_s[j]) && result.sensitivity_s[j] >= 0.0) << what << ", cell " << j;
  }
  for (const SourceEstimate& source : result.sources) {
    EXPECT_TRUE(source.p_W.allFinite()) << what;
    EXPECT_TRUE(std::isfinite(source.activity_Bq) && source.activity_Bq >= 0.0) << what << ": " << source.activity_Bq;
    if (result.estimator != "joint") continue;
    EXPECT_TRUE(std::isfinite(source.activity_sigma_Bq)) << what;
    EXPECT_TRUE(source.position_sigma_m.allFinite()) << what;
  }
  if (result.estimator != "joint") return;
  EXPECT_TRUE(std::isfinite(result.log_likelihood)) << what;
  EXPECT_TRUE(std::isfinite(result.certificate_s)) << what;
  EXPECT_TRUE(result.coverage >= 0.0 && result.coverage <= 1.0) << what << ": " << result.coverage;
}

MeasurementBatch viewpoint(const Eigen::Vector3d& p_WD, std::int32_t live_us, std::int32_t singles) {
  MeasurementBatch batch{.live_us = live_us, .p_WD = p_WD, .channels = {{.nuclide = "Cs-137", .singles = singles}}};
  batch.key.sender = 1;
  batch.q_WD = Eigen::Quaterniond(0, 1, 0, 0);
  return batch;
}

Cone cone_at(const Eigen::Vector3d& p_WS, const Eigen::Vector3d& axis_W, double beta_rad) {
  return {.p_WS = p_WS, .axis_W = axis_W, .cos_beta = std::cos(beta_rad), .weight = 1.0};
}

TEST(Reconstruction, FindsTheSourcesOfARecordingAndTellsWhenItConverged) {
  const auto batches = field_batches();
  double last_share = 0.0;
  const Reconstruction joint =
      reconstruct({}, field_cells(), toy_table(), toy_cones(), batches, [&](double share) { last_share = share; });
  EXPECT_EQ(last_share, 1.0);
  ASSERT_EQ(joint.sources.size(), 2u);
  EXPECT_TRUE(joint.converged);
  EXPECT_LT((joint.sources[0].p_W - Eigen::Vector3d(11.6, 10.1, 0.0)).norm(), 0.3);
  EXPECT_LT((joint.sources[1].p_W - Eigen::Vector3d(4.3, 5.2, 0.0)).norm(), 0.5);
  EXPECT_NEAR(joint.sources[0].activity_Bq, 4e9, 4.0 * joint.sources[0].activity_sigma_Bq);
  const Reconstruction mlem = answer("mlem", batches);
  const bool seen = std::any_of(mlem.sources.begin(), mlem.sources.end(), [](const SourceEstimate& source) {
    return (source.p_W - Eigen::Vector3d(11.6, 10.1, 0.0)).norm() < 1.5 && source.activity_Bq > 1e9;
  });
  EXPECT_TRUE(seen) << "the map has its maxima where the sources are, among others";
  EXPECT_EQ(mlem.lambda_Bq, joint.lambda_Bq) << "the map does not depend on who makes the sources";
  EXPECT_GT(mlem.map_change, 0.0);
  EXPECT_LT(mlem.map_change, 0.5);
}

TEST(Reconstruction, MoreIterationsMoveLess) {
  const auto batches = field_batches();
  double before = 1.0;
  for (const int iterations : {2, 5, 10, 40, 200}) {
    const double change = reconstruct({.estimator = "mlem", .mlem = {.iterations = iterations}}, field_cells(),
                                      toy_table(), toy_cones(), batches)
                              .map_change;
    EXPECT_LT(change, before) << iterations;
    before = change;
  }
  EXPECT_LT(before, 1e-2);
}

TEST(Reconstruction, ANuclideThatNothingWasMeasuredOfHasNoSources) {
  const auto batches = field_batches();
  for (const char* estimator : {"mlem", "joint"}) {
    const Reconstruction result =
        reconstruct({.nuclide = "Co-60", .estimator = estimator}, field_cells(), toy_table(), toy_cones(), batches);
    expect_finite(result, estimator);
    EXPECT_TRUE(result.sources.empty()) << estimator;
    EXPECT_EQ(result.events.singles + result.events.cones, 0) << estimator;
    EXPECT_GT(result.events.live_s, 0.0) << estimator << ": that nothing was seen is a measurement, too";
  }
}

TEST(Reconstruction, CountsWhatItWorksOn) {
  std::vector<MeasurementBatch> batches = {viewpoint({1, 1, 2}, 40'000, 7), viewpoint({2, 1, 2}, 0, 5)};
  batches[0].cones = {cone_at({1, 1, 2}, {0, 0, -1}, 0.5), cone_at({1, 1, 2}, {0, 0, -1}, 0.6)};
  batches[1].cones = {cone_at({1, 1, 2}, {0, 0, -1}, 0.7)};
  const MeasuredEvents events = measured_events(batches, "Cs-137");
  EXPECT_EQ(events.viewpoints, 1);
  EXPECT_DOUBLE_EQ(events.live_s, 0.04);
  EXPECT_EQ(events.singles, 7) << "counts without live time are not counts";
  EXPECT_EQ(events.photons, 2) << "two hypotheses of one photon, one of another";
  EXPECT_EQ(events.cones, 3);
}

TEST(Reconstruction, LeavesOutWhatIsBelowTheGround) {
  std::vector<MeasurementBatch> batches = {viewpoint({1, 1, 2}, 50'000, 1), viewpoint({2, 1, -1}, 50'000, 1),
                                           viewpoint({3, 1, 0}, 50'000, 1)};
  batches[0].cones = {cone_at({1, 1, 2}, {0, 0, -1}, 0.5), cone_at({1, 1, -0.1}, {0, 0, -1}, 0.5)};
  std::int64_t below = 0;
  const auto above = above_ground(batches, 0.0, below);
  EXPECT_EQ(below, 2);
  ASSERT_EQ(above.size(), 2u) << "on the ground is not below it";
  EXPECT_EQ(above[0].cones.size(), 1u);
  EXPECT_EQ(above_ground(batches, -5.0, below).size(), 3u) << "the ground may lie deeper";
}

TEST(Reconstruction, RefusesWhatItCannotHold) {
  const auto batches = field_batches();
  const Cells cells = field_cells();
  EXPECT_THROW((void)reconstruct({.estimator = "luck"}, cells, toy_table(), toy_cones(), batches),
               std::invalid_argument);
  EXPECT_THROW((void)reconstruct({}, Cells(0.5, {}), toy_table(), toy_cones(), batches), std::invalid_argument);
  // A million photons in one second, on a small computer.
  MeasurementBatch flood = viewpoint({8, 8, 2}, 1'000'000, 1'000'000);
  flood.cones.assign(1'000'000, cone_at({8, 8, 2}, {0, 0, -1}, 0.5));
  for (std::int32_t i = 0; i < 1'000'000; ++i) flood.cones[static_cast<std::size_t>(i)].event = i;
  for (const char* estimator : {"mlem", "joint"}) {
    try {
      (void)reconstruct({.estimator = estimator, .memory_max_B = 1e9}, cells, toy_table(), toy_cones(), {{flood}});
      ADD_FAILURE() << estimator << " took it";
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find("1000000 cones"), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("1.0 GB are the most"), std::string::npos) << error.what();
    }
  }
}

/// Things that happen in recordings, each beside a good one, so that its harm would show, and alone.
struct Odd {
  std::string name;
  std::vector<MeasurementBatch> batches;
};

std::vector<Odd> odd_recordings() {
  const Cells cells = field_cells();
  std::vector<Odd> odd = {{"no batches at all", {}},
                          {"no events at all", {viewpoint({8, 8, 2}, 50'000, 0)}},
                          {"no live time", {viewpoint({8, 8, 2}, 0, 3)}},
                          {"negative live time", {viewpoint({8, 8, 2}, -50'000, 3)}},
                          {"a million singles in one second", {viewpoint({8, 8, 2}, 1'000'000, 1'000'000)}},
                          {"a detector at a cell", {viewpoint(cells.p_W(500), 50'000, 3)}},
                          {"a detector below the ground", {viewpoint({8, 8, -2}, 50'000, 3)}},
                          {"a detector far away", {viewpoint({1e6, 8, 2}, 50'000, 3)}}};
  Odd at_cell{"cones at a cell", {viewpoint(cells.p_W(500), 50'000, 1)}};
  Odd below{"cones below the ground", {viewpoint({8, 8, -3}, 50'000, 1)}};
  Odd sky{"cones into the sky", {viewpoint({8, 8, 2}, 50'000, 1)}};
  Odd timeless{"cones without live time", {viewpoint({8, 8, 2}, 0, 0)}};
  int event = 0;
  for (const double beta_rad : {0.0, 0.5, 1.57079632679, 3.0, 3.14159265358979}) {
    for (const Eigen::Vector3d& axis_W :
         {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0, 0, -1), Eigen::Vector3d(1, 0, 0)}) {
      for (Odd* each : {&at_cell, &below, &timeless}) {
        each->batches[0].cones.push_back(cone_at(each->batches[0].p_WD, axis_W, beta_rad));
        each->batches[0].cones.back().event = event;
      }
      ++event;
    }
  }
  sky.batches[0].cones = {cone_at({8, 8, 2}, {0, 0, 1}, 0.1)};
  for (Odd* each : {&at_cell, &below, &sky, &timeless}) odd.push_back(*each);
  return odd;
}

TEST(Reconstruction, OddRecordingsHaveFiniteAnswers) {
  for (const Odd& odd : odd_recordings()) {
    for (const char* estimator : {"mlem", "joint"}) {
      expect_finite(answer(estimator, odd.batches), odd.name + ", " + estimator);
    }
  }
}

TEST(Reconstruction, WithoutLiveTimeThereIsNoSensitivityNoActivityAndNoSource) {
  for (const std::int32_t live_us : {0, -50'000}) {
    MeasurementBatch batch = viewpoint({8, 8, 2}, live_us, 9);
    for (const char* estimator : {"mlem", "joint"}) {
      const Reconstruction result = answer(estimator, {batch});
      EXPECT_EQ(*std::max_element(result.sensitivity_s.begin(), result.sensitivity_s.end()), 0.0) << estimator;
      EXPECT_EQ(*std::max_element(result.lambda_Bq.begin(), result.lambda_Bq.end()), 0.0) << estimator;
      EXPECT_TRUE(result.sources.empty()) << estimator;
    }
  }
}

TEST(Reconstruction, OddBatchesBesideGoodOnesDoNoHarm) {
  std::vector<MeasurementBatch> batches = field_batches();
  const Reconstruction right = answer("joint", batches);
  for (const Odd& odd : odd_recordings()) {
    if (odd.name.starts_with("a million")) continue;  // that is a source, whatever the others say
    std::int64_t below = 0;
    for (const MeasurementBatch& batch : above_ground(odd.batches, 0.0, below)) batches.push_back(batch);
  }
  const Reconstruction result = answer("joint", batches);
  expect_finite(result, "all together");
  ASSERT_EQ(result.sources.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_LT((result.sources[k].p_W - right.sources[k].p_W).norm(), 0.3) << "source " << k;
  }
}

}  // namespace
}  // namespace comptonaut
