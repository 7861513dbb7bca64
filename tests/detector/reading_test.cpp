// SPDX-License-Identifier: BSD-3-Clause
#include "detector/reading.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "physics/kinematics.h"

namespace comptonaut {
namespace {

constexpr double kLine_keV = 661.657;
constexpr double kDegree = std::numbers::pi / 180.0;

const PairReader& reader() {
  static const PairReader of_line(kLine_keV);
  return of_line;
}

/// A photon that scattered once by this angle and was absorbed, measured well.
Reading read(double beta_deg, double sigma_keV = 1.0, double distance_m = 1.5e-3) {
  const double photon_keV = scattered_keV(kLine_keV, std::cos(beta_deg * kDegree));
  return reader().read({kLine_keV - photon_keV, sigma_keV}, {photon_keV, sigma_keV}, distance_m);
}

TEST(PairReader, TellsComptonsAngle) {
  for (const double beta_deg : {30.0, 60.0, 90.0, 120.0, 140.0}) {
    EXPECT_NEAR(read(beta_deg).beta_rad / kDegree, beta_deg, 1.0) << beta_deg;
    EXPECT_NEAR(read(beta_deg, 5.0).beta_rad / kDegree, beta_deg, beta_deg < 130.0 ? 2.5 : 6.0) << beta_deg;
  }
}

TEST(PairReader, SharesOutWhatTheSumLacksAsTheVariancesAre) {
  const double photon_keV = scattered_keV(kLine_keV, 0.0);
  const Reading exact = reader().read({kLine_keV - photon_keV, 2.0}, {photon_keV, 4.0}, 1e-3);
  const Reading off = reader().read({kLine_keV - photon_keV - 2.0, 2.0}, {photon_keV - 8.0, 4.0}, 1e-3);
  EXPECT_NEAR(off.beta_rad, exact.beta_rad, 1e-3);
  EXPECT_LT(off.likelihood, exact.likelihood);
}

// Beyond the Compton edge lies what electrons' momenta and a second scatter leave: seldom, and of no sharp angle.
TEST(PairReader, KeepsAReadingBeyondTheComptonEdgeAtASmallProbability) {
  double before = 1.0;
  for (const double electron_keV : {470.0, 490.0, 510.0, 540.0}) {
    const ClusterEnergy high{electron_keV, 7.0}, low{kLine_keV - electron_keV, 4.0};
    const double likelihood = reader().read(high, low, 1.5e-3).likelihood;
    const double share = likelihood / (likelihood + reader().read(low, high, 1.5e-3).likelihood);
    EXPECT_LT(share, before) << electron_keV;
    EXPECT_GT(share, 0.1) << electron_keV;
    before = share;
  }
  EXPECT_LT(reader().read({640.0, 7.0}, {21.657, 2.0}, 1.5e-3).likelihood,
            1e-6 * reader().read({21.657, 2.0}, {640.0, 7.0}, 1.5e-3).likelihood);
}

// 180 keV are gone: the second electron's photon took them along, and the first electron alone tells the angle.
TEST(PairReader, TakesTheAngleFromTheElectronWhereThePhotonEscaped) {
  const double photon_keV = scattered_keV(kLine_keV, 0.5);
  const Reading escaped = reader().read({kLine_keV - photon_keV, 3.0}, {photon_keV - 180.0, 4.0}, 1.5e-3);
  EXPECT_NEAR(escaped.beta_rad / kDegree, 60.0, 2.0);
}

TEST(PairReader, AnXRayThatEscapedBelongsToEitherCluster) {
  const double photon_keV = scattered_keV(kLine_keV, 0.0);
  const ClusterEnergy whole_1{kLine_keV - photon_keV, 4.0}, whole_2{photon_keV, 4.0};
  const double beta_rad = reader().read(whole_1, {photon_keV - 27.0, 4.0}, 1e-3).beta_rad;
  const double other_rad = reader().read({whole_1.energy_keV - 27.0, 4.0}, whole_2, 1e-3).beta_rad;
  EXPECT_TRUE(beta_rad > 90.0 * kDegree && beta_rad < 100.0 * kDegree) << beta_rad / kDegree;
  EXPECT_TRUE(other_rad < 90.0 * kDegree && other_rad > 80.0 * kDegree) << other_rad / kDegree;
}

// Photons of little energy do not come far.
TEST(PairReader, PrefersTheReadingWhosePhotonReachesSoFar) {
  const ClusterEnergy weak{250.0, 5.0}, strong{kLine_keV - 250.0, 6.0};
  const auto odds = [&](double distance_m) {
    return reader().read(strong, weak, distance_m).likelihood / reader().read(weak, strong, distance_m).likelihood;
  };
  EXPECT_GT(odds(1e-3), 1.2 * odds(8e-3));
}

TEST(PairReader, ExplainsWhateverSumInTheWindow) {
  for (const double sum_keV : {530.0, 600.0, 661.657, 720.0, 790.0}) {
    const Reading reading = reader().read({0.5 * sum_keV, 6.0}, {0.5 * sum_keV, 6.0}, 1.5e-3);
    EXPECT_GT(reading.likelihood, 0.0) << sum_keV;
    EXPECT_TRUE(reading.beta_rad > 0.0 && reading.beta_rad < std::numbers::pi) << sum_keV;
  }
}

TEST(PairReader, TwoScattersLeaveTheElectronsMoreThanOne) {
  EXPECT_NEAR(two_scatters_keV(kLine_keV), 554.6, 0.1);
  EXPECT_GT(two_scatters_keV(kLine_keV), compton_edge_keV(kLine_keV));
}

}  // namespace
}  // namespace comptonaut
