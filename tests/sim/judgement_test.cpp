// SPDX-License-Identifier: BSD-3-Clause
#include "sim/judgement.h"

#include <gtest/gtest.h>

namespace comptonaut {
namespace {

const std::vector<TrueSource> kTruth = {{"Cs-137", {10, 10, 0}, 1e9}, {"Cs-137", {40, 10, 0}, 1e9}};

SourceReport report(const std::string& estimator, const std::vector<Eigen::Vector3d>& places) {
  SourceReport result;
  result.utime = 5 * kSecond_us;
  result.estimator = estimator;
  result.coverage = 0.25;
  for (const Eigen::Vector3d& p_W : places) {
    SourceEstimate& estimate = result.sources.emplace_back();
    estimate.nuclide = "Cs-137";
    estimate.p_W = p_W;
    estimate.activity_Bq = 1e9;
  }
  return result;
}

TEST(Judge, TellsTimeAndCoverageOfTheReport) {
  const Judgement step = judge(report("mlem", {}), kTruth, Scenario{}, 2 * kSecond_us);
  EXPECT_EQ(step.t_s, 3.0);
  EXPECT_EQ(step.coverage, 0.25);
  EXPECT_NEAR(step.localisation.rmse_m, std::hypot(50.0, 50.0), 1e-12);
}

TEST(Judge, LeavesEstimatesOnThePatchOutBeforeItTakesTheStrongest) {
  Scenario scenario;
  scenario.patch = Patch{.x_m = 30, .y_m = 30, .radius_m = 5, .activity_Bq = 4e9};
  const SourceReport two_on_the_patch = report("mlem", {{30, 30, 0}, {34, 30, 0}, {10, 10, 0}, {40, 10, 0}});
  const Judgement step = judge(two_on_the_patch, kTruth, scenario, 0);
  EXPECT_EQ(step.localisation.found_2m, 2);
  EXPECT_EQ(step.localisation.reported, 2);
  EXPECT_EQ(step.localisation.false_reports, 0);
}

Judgement step_of(double t_s, int found, int false_reports) {
  return {.t_s = t_s, .localisation = {.found_2m = found, .false_reports = false_reports, .nearest_m = {1.0, 1.0}}};
}

TEST(TimeToSuccess, IsTheStartOfTheUnbrokenSuccessAtTheEnd) {
  const std::vector<Judgement> steps = {step_of(1, 2, 0), step_of(2, 1, 0), step_of(3, 2, 1), step_of(4, 2, 0),
                                        step_of(5, 2, 0)};
  EXPECT_EQ(time_to_success_s(steps), 4.0);
  EXPECT_EQ(time_to_success_s(std::span(steps).first(3)), std::nullopt);
  EXPECT_EQ(time_to_success_s({}), std::nullopt);
}

}  // namespace
}  // namespace comptonaut
