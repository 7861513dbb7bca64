// SPDX-License-Identifier: BSD-3-Clause
#include "response/angular_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/random.h"
#include "response/angle_histogram.h"
#include "response/fit_cone_density.h"

namespace comptonaut {
namespace {

constexpr double kPi = std::numbers::pi;

/// Two clusters 2 mm apart along x; cone A points to +x, B to -x.
DetectorEvent pair_along_x(double probability_a) {
  DetectorEvent pair;
  pair.first = {.x_px = 140.0, .y_px = 100.0};
  pair.second = {.x_px = 104.0, .y_px = 100.0};
  pair.hypotheses = {
      .a = {.axis_D = Eigen::Vector3d::UnitX(), .cos_beta = std::cos(1.0), .probability = probability_a},
      .b = {.axis_D = -Eigen::Vector3d::UnitX(), .cos_beta = std::cos(0.5), .probability = 1.0 - probability_a}};
  return pair;
}

Deposit deposit_near(const SensorConfig& sensor, double x_px, Process process) {
  return {.p_D = pixel_to_D(sensor, x_px, 100.0, 300.0), .energy_keV = 100.0, .process = process};
}

/// In the plane of x and z, at this angle from +x.
Eigen::Vector3d at_angle(double angle_rad) { return {std::cos(angle_rad), 0.0, std::sin(angle_rad)}; }

TEST(CompareWithPhoton, TakesTheClusterOfTheFirstScatteringForTheTruth) {
  for (const bool mirrored : {false, true}) {
    const SensorConfig sensor{.mirror_x = mirrored};
    const Deposit scatter = deposit_near(sensor, 138.0, Process::kCompton);
    const auto is_a = compare_with_photon(pair_along_x(0.4), std::span(&scatter, 1), at_angle(1.1), sensor);
    EXPECT_EQ(is_a.a_is_true, true);
    EXPECT_NEAR(delta_rad(is_a.a), 0.1, 1e-12);
    EXPECT_NEAR(delta_rad(is_a.b), kPi - 1.1 - 0.5, 1e-12);
    EXPECT_NEAR(true_error_rad(is_a).value(), 0.1, 1e-12);
    EXPECT_NEAR(best_error_rad(is_a), 0.1, 1e-12);
    const Deposit other = deposit_near(sensor, 110.0, Process::kCompton);
    EXPECT_EQ(compare_with_photon(pair_along_x(0.4), std::span(&other, 1), at_angle(1.1), sensor).a_is_true, false);
  }
}

TEST(CompareWithPhoton, KnowsNoTruthWithoutAScatteringAndNoErrorOfARefusedHypothesis) {
  const Deposit absorbed = deposit_near({}, 138.0, Process::kPhotoelectric);
  const auto none = compare_with_photon(pair_along_x(0.4), std::span(&absorbed, 1), at_angle(1.1), {});
  EXPECT_FALSE(none.a_is_true || true_error_rad(none));
  const Deposit scatter = deposit_near({}, 138.0, Process::kCompton);
  const auto refused = compare_with_photon(pair_along_x(0.0), std::span(&scatter, 1), at_angle(1.1), {});
  EXPECT_EQ(refused.a_is_true, true);
  EXPECT_FALSE(true_error_rad(refused)) << "the true hypothesis was not kept";
  EXPECT_NEAR(best_error_rad(refused), kPi - 1.1 - 0.5, 1e-12);
}

SimulatedPair pair_of(double probability_a, bool a_is_true, double weight = 1.0) {
  return {.a = {.cos_alpha = 0.5, .cos_beta = 0.5, .probability = probability_a},
          .b = {.cos_alpha = -0.5, .cos_beta = 0.5, .probability = 1.0 - probability_a},
          .a_is_true = a_is_true,
          .weight = weight};
}

TEST(Reliability, IsTheDiagonalForProbabilitiesThatAreRight) {
  Random random(3);
  std::vector<SimulatedPair> pairs;
  for (int i = 0; i < 100'000; ++i) {
    const double p = random.uniform();
    pairs.push_back(pair_of(p, random.uniform() < p));
  }
  const auto bins = reliability(pairs);
  ASSERT_EQ(bins.size(), 11u);
  EXPECT_EQ(bins.back().hypotheses, 0.0) << "none stands alone";
  for (std::size_t i = 0; i + 1 < bins.size(); ++i) {
    EXPECT_NEAR(bins[i].hypotheses, 20'000.0, 1000.0);
    EXPECT_NEAR(bins[i].is_true, bins[i].stated, 4.5 * 0.5 / std::sqrt(bins[i].hypotheses)) << bins[i].from;
  }
}

TEST(Reliability, CountsByWeightAndSoleHypothesesApart) {
  const std::vector<SimulatedPair> pairs{pair_of(0.25, true, 3.0), pair_of(0.25, false), pair_of(1.0, true),
                                         pair_of(0.0, true), SimulatedPair{pair_of(0.25, true, 4.0).a, {}, {}, 4.0}};
  const auto bins = reliability(pairs);
  EXPECT_NEAR(bins[2].is_true, 3.0 / 8.0, 1e-12) << "one without truth";
  EXPECT_NEAR(bins[7].is_true, 1.0 / 4.0, 1e-12);
  EXPECT_NEAR(bins[10].is_true, 0.5, 1e-12);
  EXPECT_EQ(bins[10].hypotheses, 2.0);
}

TEST(Summary, CountsByWeight) {
  const AngularSummary summary = summarize(std::vector{pair_of(0.5, true, 3.0), pair_of(0.5, false, 1.0)});
  EXPECT_EQ(summary.pairs, 2);
  EXPECT_NEAR(summary.a_is_true, 0.75, 1e-12);
  EXPECT_NEAR(summary.has_truth, 1.0, 1e-12);
  EXPECT_NEAR(summary.true_median_rad, 0.0, 1e-12);
  EXPECT_NEAR(summary.true_q95_rad, kPi / 3.0, 1e-12);
}

// Pairs drawn from a density have its histogram.
TEST(AngleHistogram, ComparesWhatWasMeasuredWithTheDensity) {
  Random random(4);
  const double kappa = std::pow(cone_sigmas_rad()[3], -2);
  std::vector<SimulatedPair> pairs;
  for (int i = 0; i < 50'000; ++i) {
    const double cos_beta = random.uniform(-1.0, 1.0), sin_beta = std::sqrt(1.0 - cos_beta * cos_beta);
    const double cos_turn = 1.0 + std::log1p(-random.uniform() * -std::expm1(-2.0 * kappa)) / kappa;
    const double across = std::sqrt(1.0 - cos_turn * cos_turn) * std::cos(random.uniform(0.0, 2.0 * kPi));
    SimulatedPair pair = pair_of(i % 2 == 0 ? 0.5 : 1.0, true);
    pair.a.cos_beta = cos_beta;
    pair.a.cos_alpha = cos_beta * cos_turn + sin_beta * across;
    pairs.push_back(pair);
  }
  double measured = 0.0, model = 0.0;
  for (const AngleBin& bin : angle_histogram(pairs, fit_cone_density(pairs))) {
    const double width_rad = bin.to_rad - bin.from_rad;
    measured += bin.measured_per_rad * width_rad;
    model += bin.model_per_rad * width_rad;
    if (bin.pairs < 100.0) continue;
    EXPECT_NEAR(bin.measured_per_rad / bin.model_per_rad, 1.0, 0.05 + 5.0 / std::sqrt(bin.pairs)) << bin.from_rad;
  }
  EXPECT_NEAR(measured, 1.0, 1e-9);
  EXPECT_NEAR(model, 1.0, 0.01);
}

}  // namespace
}  // namespace comptonaut
