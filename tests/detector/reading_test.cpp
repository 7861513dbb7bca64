// SPDX-License-Identifier: BSD-3-Clause
#include "detector/reading.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/random.h"
#include "detector/sensor.h"
#include "detector/slow_reading.h"
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

/// A pair of this line: by chance anything in its window, else a photon that scattered once, blurred.
struct MadePair {
  ClusterEnergy first, second;
  double distance_m = 0.0;
};
MadePair made_pair(double line_keV, bool by_chance, Random& random) {
  const SensorConfig sensor;
  const double photon_keV = by_chance ? line_keV * random.uniform(0.02, 0.98)
                                      : scattered_keV(line_keV, std::cos(random.uniform(0.2, std::numbers::pi)));
  const double electron_keV = by_chance ? line_keV * random.uniform(0.8, 1.2) - photon_keV : line_keV - photon_keV;
  const auto measured = [&](double energy_keV) {
    const double sigma_keV = energy_sigma_keV(sensor, energy_keV);
    const double read_keV = std::max(energy_keV + sigma_keV * random.normal(), 5.0);
    return ClusterEnergy{read_keV, energy_sigma_keV(sensor, read_keV)};
  };
  return {measured(electron_keV), measured(photon_keV), random.uniform(0.8e-3, 18e-3)};
}

TEST(PairReader, TellsWhatOneAngleAfterAnotherTells) {
  constexpr double kProbability = 1e-4, kUnlikely = 1e-3, kAngle_rad = 0.1 * kDegree;
  Random random(1);
  for (const double line_keV : {295.957, 316.506, 356.013, 364.489, 468.069, kLine_keV, 1173.228, 1332.492}) {
    const PairReader fast(line_keV);
    const slow_reading::SlowPairReader slow(line_keV);
    for (int i = 0; i < 1000; ++i) {
      const auto& [first, second, distance_m] = made_pair(line_keV, i % 2 == 0, random);
      const Reading a = fast.read(first, second, distance_m), b = fast.read(second, first, distance_m);
      const Reading slow_a = slow.read(first, second, distance_m), slow_b = slow.read(second, first, distance_m);
      const double probability_a = slow_a.likelihood / (slow_a.likelihood + slow_b.likelihood);
      ASSERT_NEAR(a.likelihood / (a.likelihood + b.likelihood), probability_a, kProbability) << line_keV << ' ' << i;
      // What is as good as impossible has no angle that matters.
      const double off_a = probability_a > kUnlikely ? a.beta_rad - slow_a.beta_rad : 0.0;
      const double off_b = probability_a < 1.0 - kUnlikely ? b.beta_rad - slow_b.beta_rad : 0.0;
      ASSERT_NEAR(off_a, 0.0, kAngle_rad) << line_keV << ' ' << i;
      ASSERT_NEAR(off_b, 0.0, kAngle_rad) << line_keV << ' ' << i;
    }
  }
}

TEST(PairReader, TwoScattersLeaveTheElectronsMoreThanOne) {
  EXPECT_NEAR(two_scatters_keV(kLine_keV), 554.6, 0.1);
  EXPECT_GT(two_scatters_keV(kLine_keV), compton_edge_keV(kLine_keV));
}

}  // namespace
}  // namespace comptonaut
