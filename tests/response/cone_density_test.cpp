// SPDX-License-Identifier: BSD-3-Clause
#include "response/cone_density.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "core/random.h"
#include "response/fit_cone_density.h"
#include "scratch.h"

namespace comptonaut {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180.0;

ConeWeights only(std::size_t part) {
  ConeWeights weights{};
  weights[part] = 1.0;
  return weights;
}

/// Two nodes with other shares, so that what lies between them is interpolated.
ConeDensity two_nodes() {
  const std::vector<ConeDensity::Node> both{{0.0, 10.0, only(1)}, {kPi, 20.0, only(4)}};
  const std::vector<ConeDensity::Node> sole{{0.0, 30.0, only(5)}};
  return ConeDensity(both, sole, {{"nuclide", "Cs-137"}});
}

double integral_over_sphere(const ConeProfile& profile) {
  constexpr int kSteps = 20'000;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double alpha_rad = (i + 0.5) * kPi / kSteps;
    sum += profile.per_sr(std::cos(alpha_rad)) * 2.0 * kPi * std::sin(alpha_rad) * kPi / kSteps;
  }
  return sum;
}

TEST(SmearedRing, HasIntegralOneForEveryAngleAndWidth) {
  for (std::size_t part = 0; part < kConeParts; ++part) {
    for (const double beta_deg : {0.0, 1.0, 30.0, 90.0, 150.0, 179.5, 180.0}) {
      const ConeProfile profile(std::cos(beta_deg * kDegree), only(part));
      EXPECT_NEAR(integral_over_sphere(profile), 1.0, 1e-5) << "part " << part << ", beta " << beta_deg;
    }
  }
}

// The slow oracle: draw points on the ring, turn each by a von Mises-Fisher angle, and count.
TEST(SmearedRing, IsARingThatAVonMisesFisherDistributionSmears) {
  Random random(1);
  const double beta_rad = 25.0 * kDegree, sigma_rad = cone_sigmas_rad()[5], kappa = 1.0 / (sigma_rad * sigma_rad);
  constexpr int kDraws = 200'000, kBins = 12;
  std::array<int, kBins> counts{};
  for (int i = 0; i < kDraws; ++i) {
    const double cos_turn = 1.0 + std::log1p(-random.uniform() * -std::expm1(-2.0 * kappa)) / kappa;
    const double around_rad = random.uniform(0.0, 2.0 * kPi);
    const double sin_turn = std::sqrt(1.0 - cos_turn * cos_turn);
    const double cos_alpha = std::cos(beta_rad) * cos_turn + std::sin(beta_rad) * sin_turn * std::cos(around_rad);
    ++counts[static_cast<std::size_t>(std::min(kBins - 1.0, kBins * std::acos(cos_alpha) / (0.5 * kPi)))];
  }
  for (int bin = 0; bin + 1 < kBins; ++bin) {
    double expected = 0.0;
    for (int i = 0; i < 100; ++i) {
      const double alpha_rad = (bin + (i + 0.5) / 100) * 0.5 * kPi / kBins;
      expected += smeared_ring_per_sr(std::cos(alpha_rad), std::cos(beta_rad), sigma_rad) * 2.0 * kPi *
                  std::sin(alpha_rad) * 0.5 * kPi / kBins / 100 * kDraws;
    }
    EXPECT_NEAR(counts[static_cast<std::size_t>(bin)], expected, 4.5 * std::sqrt(expected) + 1.0) << "bin " << bin;
  }
}

TEST(SmearedRing, IsAGaussianInDeltaWhereItIsNarrow) {
  const double sigma_rad = cone_sigmas_rad()[0];
  const ConeProfile profile(std::cos(1.0), only(0));
  for (const double sigmas : {-2.0, -1.0, 0.0, 1.0, 2.0}) {
    const double gaussian = std::exp(-0.5 * sigmas * sigmas) / (std::sqrt(2.0 * kPi) * sigma_rad);
    EXPECT_NEAR(profile.per_rad(sigmas * sigma_rad) / gaussian, 1.0, 0.02) << sigmas;
  }
  EXPECT_EQ(profile.per_rad(-1.1), 0.0) << "no such angle";
}

TEST(ConeProfile, BlursByWhatElseIsUncertain) {
  const ConeProfile sharp(std::cos(1.0), only(1)), blurred(std::cos(1.0), only(1), cone_sigmas_rad()[1]);
  EXPECT_NEAR(sharp.per_rad(0.0) / blurred.per_rad(0.0), std::sqrt(2.0), 0.01);
  EXPECT_NEAR(integral_over_sphere(blurred), 1.0, 1e-5);
}

TEST(ConeDensity, InterpolatesSharesBetweenNodesAndKeepsThemOutside) {
  const ConeDensity density = two_nodes();
  const auto at = [&](double beta_rad, Readings readings) {
    return density.profile(std::cos(beta_rad), readings).per_rad(0.01);
  };
  const double beta_rad = 0.25 * kPi;
  const double expected = 0.75 * ConeProfile(std::cos(beta_rad), only(1)).per_rad(0.01) +
                          0.25 * ConeProfile(std::cos(beta_rad), only(4)).per_rad(0.01);
  EXPECT_NEAR(at(beta_rad, Readings::kBoth), expected, 1e-12 * expected);
  EXPECT_NEAR(at(2.0, Readings::kSole), ConeProfile(std::cos(2.0), only(5)).per_rad(0.01), 1e-12);
}

TEST(ConeDensity, IsReadBackBitForBit) {
  const ConeDensity density = two_nodes();
  const auto file = scratch_file("cones.csv");
  density.save(file);
  const ConeDensity again = ConeDensity::load(file);
  EXPECT_EQ(again.nodes(Readings::kBoth), density.nodes(Readings::kBoth));
  EXPECT_EQ(again.nodes(Readings::kSole), density.nodes(Readings::kSole));
  EXPECT_EQ(again.facts(), density.facts());
}

std::string refusal(const std::string& change, const std::string& into) {
  const auto good = scratch_file("good.csv");
  two_nodes().save(good);
  std::ifstream in(good);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  text.replace(text.find(change), change.size(), into);
  try {
    static_cast<void>(ConeDensity::load(scratch_file("wrong.csv", text)));
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ConeDensity, NamesWhatIsWrongInItsFile) {
  const auto says = [](const std::string& message, const std::string& part) {
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  says(refusal("readings,", "Readings,"), "wrong.csv:2: expected 'readings,");
  says(refusal("both,0,10", "bath,0,10"), "wrong.csv:3: must be 'both' or 'sole'");
  says(refusal("both,0,10", "both,0,ten"), "wrong.csv:3");
  says(refusal("both,0,10,0,1", "both,0,10,0,2"), "sum to 1");
  says(refusal("both,0,10", "both,4,10"), "beta must grow");
  says(refusal("sole,", "both,"), "beta must grow");
  EXPECT_THROW(static_cast<void>(ConeDensity::load("/nowhere/cones.csv")), std::runtime_error);
}

/// A pair whose only interesting hypothesis is A, and true.
SimulatedPair true_pair(double cos_alpha, double cos_beta, bool sole) {
  return {.a = {.cos_alpha = cos_alpha, .cos_beta = cos_beta, .probability = sole ? 1.0 : 0.5},
          .b = {.cos_alpha = -cos_alpha, .cos_beta = 0.0, .probability = sole ? 0.0 : 0.5},
          .a_is_true = true};
}

// A fit to samples of a known mixture finds its shares.
TEST(FitConeDensity, FindsTheSharesThatMadeTheSamples) {
  Random random(2);
  std::vector<SimulatedPair> pairs;
  for (int i = 0; i < 40'000; ++i) {
    const double cos_beta = random.uniform(-1.0, 1.0), beta_rad = std::acos(cos_beta);
    const bool core = random.uniform() < 0.7;
    const double kappa = std::pow(cone_sigmas_rad()[core ? 2 : 5], -2);
    const double cos_turn = 1.0 + std::log1p(-random.uniform() * -std::expm1(-2.0 * kappa)) / kappa;
    const double around_rad = random.uniform(0.0, 2.0 * kPi);
    const double across = std::sin(beta_rad) * std::sqrt(1.0 - cos_turn * cos_turn);
    pairs.push_back(true_pair(cos_beta * cos_turn + across * std::cos(around_rad), cos_beta, i % 4 == 0));
  }
  const ConeDensity density = fit_cone_density(pairs);
  for (const ConeDensity::Node& node : density.nodes(Readings::kBoth)) {
    EXPECT_NEAR(node.weights[1] + node.weights[2] + node.weights[3], 0.7, 0.1) << node.beta_rad;
    EXPECT_NEAR(node.weights[4] + node.weights[5] + node.weights[6] + node.weights[8] + node.weights[9], 0.3, 0.1)
        << node.beta_rad;
    EXPECT_GT(node.weights[7], 0.0) << "no direction is impossible";
  }
  EXPECT_THROW(static_cast<void>(fit_cone_density({})), std::invalid_argument);
}

TEST(ConeSamples, AreOfTheSoleReadingOrOfTheTrueOne) {
  SimulatedPair pair{.a = {.cos_alpha = 0.6, .cos_beta = 0.1, .probability = 0.3},
                     .b = {.cos_alpha = -0.6, .cos_beta = 0.2, .probability = 0.7},
                     .a_is_true = false,
                     .weight = 2.0};
  const auto truth = cone_samples(pair);
  ASSERT_EQ(truth.size(), 1u);
  EXPECT_EQ(truth[0].cone.cos_beta, 0.2);
  EXPECT_EQ(truth[0].weight, 2.0);
  EXPECT_EQ(truth[0].readings, Readings::kBoth);
  pair.a_is_true.reset();
  const auto none = cone_samples(pair);
  ASSERT_EQ(none.size(), 2u);
  EXPECT_NEAR(none[0].weight, 0.6, 1e-12);
  EXPECT_NEAR(none[1].weight, 1.4, 1e-12);
  pair.a.probability = 1.0;
  pair.b.probability = 0.0;
  const auto sole = cone_samples(pair);
  ASSERT_EQ(sole.size(), 1u);
  EXPECT_EQ(sole[0].cone.cos_alpha, 0.6);
  EXPECT_EQ(sole[0].readings, Readings::kSole);
}

}  // namespace
}  // namespace comptonaut
