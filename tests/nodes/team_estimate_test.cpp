// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/team_estimate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "nodes/coordinator_fixture.h"

namespace comptonaut {
namespace {

/// Singles and pairs of one source at (6.25, 13.25).
std::vector<MeasurementBatch> measured(int duration_s) {
  std::vector<MeasurementBatch> batches = some_mission(duration_s);
  Random random(8);
  for (MeasurementBatch& batch : batches) {
    const Eigen::Vector3d to_source_W = Eigen::Vector3d(6.25, 13.25, 0) - batch.p_WD;
    batch.channels[0].singles = static_cast<int>(random.poisson(0.15 + 100.0 / to_source_W.squaredNorm()));
  }
  return batches;
}

TEST(TeamEstimate, ShowsASearchPointSourcesInTheirCellsAndTheSensitivityOfPairs) {
  CoordinatorConfig config = small_config();
  const Cells cells = flat_cells(config.area, config.cell_m);
  TeamEstimate mlem(config, cells, toy_table(), {});
  config.estimator = "joint";
  TeamEstimate joint(config, cells, toy_table(), some_cones());
  for (TeamEstimate* estimate : {&mlem, &joint}) {
    for (const MeasurementBatch& batch : measured(10)) estimate->add(batch);
    estimate->update();
  }
  const TeamEstimate::Ground ground = joint.ground(), published = mlem.ground();
  ASSERT_EQ(joint.report().sources.size(), 1U);
  const auto highest = std::max_element(ground.lambda_Bq.begin(), ground.lambda_Bq.end()) - ground.lambda_Bq.begin();
  EXPECT_LT((cells.p_W(highest) - joint.report().sources[0].p_W).norm(), 0.71 * config.cell_m);
  const auto sum = [](auto all) { return std::accumulate(all.begin(), all.end(), 0.0); };
  const double source_Bq = joint.report().sources[0].activity_Bq;
  EXPECT_NEAR(sum(ground.lambda_Bq), sum(joint.maps()[0].lambda_Bq) + source_Bq, 1e-6 * source_Bq);
  EXPECT_LT(joint.maps()[0].lambda_Bq[highest], 0.01 * source_Bq) << "shown twice";
  for (std::size_t j = 0; j < cells.size(); ++j) {
    const double s = published.pair_sensitivity_s[j];
    ASSERT_NEAR(ground.pair_sensitivity_s[j], s, 0.15 * s) << "cell " << j;
    ASSERT_GT(joint.maps()[0].sensitivity_s[j], 5.0 * s) << "cell " << j << ": singles are counted in";
  }
}

TEST(TeamEstimate, CountsWhatItsMapDid) {
  CoordinatorConfig config = small_config();
  config.estimator = "joint";
  const Cells cells = flat_cells(config.area, config.cell_m);
  TeamEstimate joint(config, cells, toy_table(), some_cones());
  joint.update();
  for (const MeasurementBatch& batch : measured(2)) joint.add(batch);
  joint.update();
  const std::vector<Counter> counters = joint.counters();
  const auto value = [&](const char* name) {
    const auto at = std::find_if(counters.begin(), counters.end(), [&](const Counter& c) { return c.name == name; });
    return at == counters.end() ? -1 : at->value;
  };
  EXPECT_EQ(value("pairs"), joint.rows());
  EXPECT_GE(value("map_steps"), 2);
  EXPECT_LE(value("map_steps"), 2 * config.joint.map_steps);
  EXPECT_EQ(value("map_updates_unconverged"), 1) << "the first update has nothing to converge on";
  EXPECT_EQ(joint.viewpoints(), 120);
}

}  // namespace
}  // namespace comptonaut
