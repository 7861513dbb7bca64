// SPDX-License-Identifier: BSD-3-Clause
#include "physics/klein_nishina.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace comptonaut {
namespace {

/// Integral over the sphere between two cosines, by the midpoint rule.
double integral_m2(double energy_keV, double from, double to) {
  constexpr int kSteps = 20'000;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) sum += klein_nishina_m2_sr(energy_keV, from + (to - from) * (i + 0.5) / kSteps);
  return 2.0 * std::numbers::pi * sum * (to - from) / kSteps;
}

TEST(KleinNishina, TotalIsTheIntegralOfTheDifferential) {
  for (const double energy_keV : {1.0, 5.0, 5.2, 59.5, 661.657, 1332.5, 3000.0}) {
    const double total_m2 = klein_nishina_m2(energy_keV);
    EXPECT_NEAR(total_m2 / integral_m2(energy_keV, -1.0, 1.0), 1.0, 1e-6) << energy_keV << " keV";
  }
}

TEST(KleinNishina, HasThomsonsLimitAndThePublishedValueForCaesium) {
  const double thomson_m2 = 8.0 / 3.0 * std::numbers::pi * kElectronRadius_m * kElectronRadius_m;
  EXPECT_NEAR(klein_nishina_m2(1e-4) / thomson_m2, 1.0, 1e-6);
  EXPECT_NEAR(klein_nishina_m2(661.657) * 1e28, 0.2561, 0.0005) << "barn";
  EXPECT_NEAR(klein_nishina_m2(5.1099) / klein_nishina_m2(5.1101), 1.0, 1e-4) << "where the series takes over";
}

TEST(KleinNishina, DrawsFollowTheDifferential) {
  constexpr int kDraws = 200'000, kBins = 40;
  for (const double energy_keV : {30.0, 661.657, 2000.0}) {
    Random random(11);
    std::array<int, kBins> seen{};
    for (int i = 0; i < kDraws; ++i) {
      const double cosine = sample_klein_nishina(energy_keV, random);
      ASSERT_TRUE(cosine >= -1.0 && cosine <= 1.0) << cosine;
      ++seen[std::min<std::size_t>(kBins - 1, static_cast<std::size_t>((cosine + 1.0) * 0.5 * kBins))];
    }
    double chi2 = 0.0;
    for (int bin = 0; bin < kBins; ++bin) {
      const double from = -1.0 + 2.0 * bin / kBins;
      const double expected = kDraws * integral_m2(energy_keV, from, from + 2.0 / kBins) / klein_nishina_m2(energy_keV);
      chi2 += std::pow(seen[static_cast<std::size_t>(bin)] - expected, 2) / expected;
    }
    EXPECT_LT(chi2, kBins + 5.0 * std::sqrt(2.0 * kBins)) << energy_keV << " keV";
  }
}

}  // namespace
}  // namespace comptonaut
