// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/more_nuclides.h"

#include <gtest/gtest.h>

#include "nodes/coordinator_fixture.h"
#include "nodes/plan_of.h"
#include "nodes/team_estimate.h"

namespace comptonaut {
namespace {

const std::filesystem::path kTables = std::filesystem::path(COMPTONAUT_SOURCE_DIR) / "config/response";

/// A table like toy_table() that gives so many times as many singles and pairs.
ResponseTable times(double factor) {
  std::vector<ResponseEntry> entries = toy_table().entries();
  for (ResponseEntry& entry : entries) entry.single *= factor, entry.pair *= factor;
  return ResponseTable(entries);
}

constexpr double kLeft = 1.3;  // in the channel of Cs-137, per single of Co-60's own

std::vector<MoreNuclide> cobalt() {
  return {{.nuclide = "Co-60", .own = {toy_table(), some_cones()}, .left = {{times(kLeft), some_cones()}}}};
}

struct Field {
  std::vector<PointSource> caesium, cobalt;
};

/// Singles alone, on flights that cross each other all over the field: cones of the fixture are taken out.
std::vector<MeasurementBatch> measured(const Field& field) {
  std::vector<MeasurementBatch> batches = some_mission(30);
  Random random(77);
  for (MeasurementBatch& batch : batches) {
    const double turn_rad = 0.02 * static_cast<double>(batch.key.number) + 2.1 * batch.key.sender;
    batch.p_WD = {10 + 8 * std::sin(2.0 * turn_rad), 10 + 8 * std::sin(turn_rad + batch.key.sender), 2.0};
    const auto expected = [&](const std::vector<PointSource>& sources) {
      double sum = 0.0;
      for (const PointSource& source : sources) {
        const double square_m2 = (source.p_W - batch.p_WD).squaredNorm();
        sum += 0.05 * 1e-6 * source.activity_Bq * std::exp(-0.0093 * std::sqrt(square_m2)) / square_m2;
      }
      return sum;
    };
    const double low = 0.15 + 1.24 * (expected(field.caesium) + kLeft * expected(field.cobalt));
    batch.cones.clear();
    batch.channels = {{.nuclide = "Cs-137", .singles = static_cast<int>(random.poisson(low))},
                      {.nuclide = "Co-60", .singles = static_cast<int>(random.poisson(0.01 + expected(field.cobalt)))}};
  }
  return batches;
}

TeamEstimate estimated(const Field& field, const Cells& cells, const std::vector<MoreNuclide>& more) {
  CoordinatorConfig config = small_config();
  config.estimator = "joint";
  config.joint.use_pairs = false;
  TeamEstimate estimate(config, cells, toy_table(), some_cones(), more);
  const auto batches = measured(field);
  for (std::size_t i = 0; i < batches.size(); ++i) {
    estimate.add(batches[i]);
    if (i % 60 == 59) estimate.update();
  }
  return estimate;
}

const Cells& cells() {
  static const Cells shared = flat_cells({0, 20, 0, 20}, 0.5);
  return shared;
}

const PointSource kA{.p_W = {6.2, 13.3, 0}, .activity_Bq = 2e9}, kB{.p_W = {14.1, 6.4, 0}, .activity_Bq = 1.5e9};

TEST(MoreNuclides, ASourceOfTheUpperLineIsNoneOfTheLower) {
  const auto alone = estimated({.caesium = {}, .cobalt = {kA}}, cells(), {}).report().sources;
  ASSERT_EQ(alone.size(), 1U) << "else the test says nothing";
  EXPECT_EQ(alone[0].nuclide, "Cs-137");
  const auto sources = estimated({.caesium = {}, .cobalt = {kA}}, cells(), cobalt()).report().sources;
  ASSERT_EQ(sources.size(), 1U);
  EXPECT_EQ(sources[0].nuclide, "Co-60");
  EXPECT_LT((sources[0].p_W - kA.p_W).norm(), 0.3);
}

TEST(MoreNuclides, BothAtOnceAreBothFoundAndMapped) {
  const TeamEstimate estimate = estimated({.caesium = {kB}, .cobalt = {kA}}, cells(), cobalt());
  const auto sources = estimate.report().sources;
  ASSERT_EQ(sources.size(), 2U);
  const bool first = sources[0].nuclide == "Co-60";
  EXPECT_NE(sources[0].nuclide, sources[1].nuclide);
  EXPECT_LT((sources[first ? 0 : 1].p_W - kA.p_W).norm(), 0.3);
  EXPECT_LT((sources[first ? 1 : 0].p_W - kB.p_W).norm(), 0.3);
  ASSERT_EQ(estimate.maps().size(), 2U);
  EXPECT_EQ(estimate.maps()[1].nuclide, "Co-60");
  EXPECT_EQ(estimate.maps()[1].lambda_Bq.size(), cells().size());
  EXPECT_EQ(estimate.clearance().back().nuclide, "Co-60");
}

TEST(MoreNuclides, ASourceHidesNoEqualOneOfAnotherNuclideAMetreAside) {
  const PointSource caesium{.p_W = {16.2, 10.3, 0}, .activity_Bq = 2e9},
      beside{.p_W = {17.2, 10.3, 0}, .activity_Bq = 2e9};
  const TeamEstimate estimate = estimated({.caesium = {caesium}, .cobalt = {beside}}, cells(), cobalt());
  const auto sources = estimate.report().sources;
  ASSERT_EQ(sources.size(), 2U);
  for (const SourceEstimate& source : sources) {
    const PointSource& truth = source.nuclide == "Co-60" ? beside : caesium;
    EXPECT_LT((source.p_W - truth.p_W).norm(), 0.4) << source.nuclide;
    EXPECT_NEAR(source.activity_Bq, truth.activity_Bq, 3.0 * source.activity_sigma_Bq) << source.nuclide;
  }
  EXPECT_NE(sources[0].nuclide, sources[1].nuclide);
}

TEST(MoreNuclides, ASourceOfTheUpperLineIsPlacedByBothChannels) {
  std::vector<MoreNuclide> unseen_below = cobalt();
  unseen_below[0].left[0].response = times(1e-9);
  const auto sigma_m = [&](const std::vector<MoreNuclide>& more) {
    for (const SourceEstimate& source : estimated({.caesium = {}, .cobalt = {kA}}, cells(), more).report().sources) {
      if (source.nuclide != "Co-60") continue;
      EXPECT_LT((source.p_W - kA.p_W).norm(), 4.0 * source.position_sigma_m.norm());
      return source.position_sigma_m.head<2>().norm();
    }
    ADD_FAILURE() << "not found";
    return 0.0;
  };
  EXPECT_LT(sigma_m(cobalt()), 0.75 * sigma_m(unseen_below)) << "2.3 times the counts";
}

TEST(MoreNuclides, ASearchLooksIntoEachChannel) {
  const TeamEstimate estimate = estimated({.caesium = {kB}, .cobalt = {kA}}, cells(), cobalt());
  ASSERT_EQ(estimate.looks().size(), 2U);
  EXPECT_EQ(estimate.looks()[0].size(), estimate.looks()[1].size());
  const SearchFacts facts = search_facts(small_config(), toy_table(), cobalt());
  ASSERT_EQ(facts.channels.size(), 2U);
  EXPECT_EQ(facts.channels[1].nuclide, "Co-60");
  ASSERT_EQ(facts.channels[0].lines.size(), 2U);
  EXPECT_NEAR(facts.channels[0].lines[1].single_response, kLeft * facts.channels[1].lines[0].single_response, 1e-12);
}

TEST(MoreNuclides, NeedTheEstimatorThatCanTellThemApart) {
  CoordinatorConfig config = small_config();
  config.estimator = "mlem";
  EXPECT_THROW(TeamEstimate(config, cells(), toy_table(), {}, cobalt()), std::invalid_argument);
}

TEST(MoreNuclides, ComeWithTheirTables) {
  CoordinatorConfig config{.response_table = kTables / "cs-137.csv", .more_nuclides = {"Co-60-1332"}};
  const auto more = load_more_nuclides(config);
  ASSERT_EQ(more.size(), 1U);
  ASSERT_EQ(more[0].left.size(), 1U);
  EXPECT_EQ(more[0].own.response.facts().at("nuclide"), "Co-60-1332");
  // What is left of Co-60 below is more than what its upper line gives above.
  EXPECT_GT(mean_single(more[0].left[0].response), 5.0 * mean_single(more[0].own.response));
  const ResponseTable caesium = ResponseTable::load(config.response_table);
  EXPECT_NEAR(attenuation_per_m(more[0].own.response, caesium, 0.0093), 0.0067, 0.0001) << "NIST: 0.00555 m2/kg";
  EXPECT_EQ(attenuation_per_m(caesium, caesium, 0.0093), 0.0093);
  config.more_nuclides = {"Xx-1"};
  EXPECT_THROW((void)load_more_nuclides(config), std::runtime_error);
}

}  // namespace
}  // namespace comptonaut
