// SPDX-License-Identifier: BSD-3-Clause
#include "physics/kinematics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "physics/line.h"

namespace comptonaut {
namespace {

TEST(ScatterCosine, UndoesComptonsFormula) {
  for (const double energy_keV : {59.5, 356.0, kLine_keV, 1332.5}) {
    for (double cos_beta = -0.99; cos_beta < 0.995; cos_beta += 0.03) {
      const double photon_keV = scattered_keV(energy_keV, cos_beta);
      const auto found = scatter_cosine(energy_keV - photon_keV, photon_keV);
      ASSERT_TRUE(found) << energy_keV << " keV, cos " << cos_beta;
      EXPECT_NEAR(*found, cos_beta, 1e-9) << energy_keV << " keV";
    }
  }
}

TEST(ScatterCosine, KnowsTheLimitsOfCaesium) {
  EXPECT_NEAR(compton_edge_keV(kLine_keV), 477.3, 0.05);
  EXPECT_NEAR(scattered_keV(kLine_keV, -1.0), 184.3, 0.05);
  EXPECT_TRUE(scatter_cosine(477.0, kLine_keV - 477.0));
  EXPECT_FALSE(scatter_cosine(478.0, kLine_keV - 478.0)) << "beyond backscatter";
}

TEST(ScatterCosine, RefusesEnergiesThatAreNone) {
  for (const double wrong : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(static_cast<void>(scatter_cosine(wrong, 100.0)), std::invalid_argument) << wrong;
    EXPECT_THROW(static_cast<void>(scatter_cosine(100.0, wrong)), std::invalid_argument) << wrong;
    EXPECT_THROW(static_cast<void>(scatter_cosine_of_line({100.0, 200.0}, {1.0, 1.0}, wrong)), std::invalid_argument);
  }
}

// The constrained energies are the least squares solution: none on the line is nearer in units of sigma.
TEST(ConstrainToLine, IsTheNearestPointOfTheLine) {
  const PairEnergies measured{.electron_keV = 210.0, .photon_keV = 430.0},
      sigma{.electron_keV = 5.0, .photon_keV = 8.0};
  const PairEnergies fitted = constrain_to_line(measured, sigma, kLine_keV);
  EXPECT_NEAR(fitted.electron_keV + fitted.photon_keV, kLine_keV, 1e-9);
  const auto chi2 = [&](double electron_keV) {
    return std::pow((electron_keV - measured.electron_keV) / sigma.electron_keV, 2) +
           std::pow((kLine_keV - electron_keV - measured.photon_keV) / sigma.photon_keV, 2);
  };
  for (const double step_keV : {-3.0, -0.1, 0.1, 3.0}) {
    EXPECT_GT(chi2(fitted.electron_keV + step_keV), chi2(fitted.electron_keV)) << step_keV;
  }
}

TEST(ScatterCosineOfLine, RecoversTheAngleFromEnergiesThatMissTheLine) {
  const double photon_keV = scattered_keV(kLine_keV, 0.3), electron_keV = kLine_keV - photon_keV;
  EXPECT_NEAR(scatter_cosine_of_line({electron_keV, photon_keV}, {5.0, 5.0}, kLine_keV).value(), 0.3, 1e-12);
  EXPECT_NEAR(scatter_cosine_of_line({electron_keV - 6.0, photon_keV - 6.0}, {5.0, 5.0}, kLine_keV).value(), 0.3, 1e-12)
      << "the same loss in both, equal sigma";
  EXPECT_NEAR(scatter_cosine_of_line({electron_keV - 9.0, photon_keV}, {5.0, 0.0}, kLine_keV).value(), 0.3, 1e-12)
      << "all the uncertainty is the electron's";
  EXPECT_NEAR(scatter_cosine_of_line({1.0, photon_keV}, {0.0, 0.0}, kLine_keV).value(), 0.3, 1e-12)
      << "E_0 is the line, E_2 as measured";
  EXPECT_FALSE(scatter_cosine_of_line({1.0, 900.0}, {5.0, 5.0}, kLine_keV)) << "negative after the fit";
}

}  // namespace
}  // namespace comptonaut
