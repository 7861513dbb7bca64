// SPDX-License-Identifier: BSD-3-Clause
#include "physics/scatter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "physics/compton.h"
#include "physics/kinematics.h"
#include "physics/line.h"

namespace comptonaut {
namespace {

TEST(Deflect, KeepsTheAngleAndGoesAllAround) {
  Random random(1);
  const Eigen::Vector3d direction = Eigen::Vector3d(1, -2, 0.5).normalized();
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (int i = 0; i < 20'000; ++i) {
    const Eigen::Vector3d turned = deflect(direction, -0.4, random);
    EXPECT_NEAR(turned.norm(), 1.0, 1e-12);
    EXPECT_NEAR(turned.dot(direction), -0.4, 1e-12);
    mean += turned / 20'000;
  }
  EXPECT_LT((mean + 0.4 * direction).norm(), 0.03);
}

TEST(Doppler, IsComptonsFormulaForAnElectronAtRest) {
  for (const double cosine : {-0.9, 0.0, 0.7}) {
    EXPECT_NEAR(doppler_keV(kLine_keV, cosine, 0.0), scattered_keV(kLine_keV, cosine), 1e-9) << cosine;
  }
}

// The electron's momentum along the momentum transfer, from the definition, gives back the one put in.
TEST(Doppler, UndoesTheDefinitionOfTheProjectedMomentum) {
  for (const double momentum_mc : {-0.3, -0.01, 0.02, 0.25}) {
    for (const double cosine : {-0.95, -0.2, 0.6}) {
      const double before = kLine_keV, after = doppler_keV(before, cosine, momentum_mc);
      const double transfer_keV = std::sqrt(before * before + after * after - 2.0 * before * after * cosine);
      const double found =
          (before * after * (1.0 - cosine) - kElectronMass_keV * (before - after)) / (kElectronMass_keV * transfer_keV);
      EXPECT_NEAR(found, momentum_mc, 1e-9) << "cos " << cosine;
    }
  }
}

TEST(SampleCompton, PaysTheBindingEnergyAndBroadensTheLine) {
  const Atom tellurium = load_atom(52);
  Random random(2);
  std::vector<double> shift_keV;
  for (int i = 0; i < 300'000; ++i) {
    const ComptonScatter scatter = sample_compton(tellurium, kLine_keV, random);
    ASSERT_GT(scatter.photon_keV, 0.0);
    ASSERT_LE(scatter.photon_keV, kLine_keV - tellurium.shells[scatter.shell].binding_keV);
    if (std::abs(scatter.cos_angle) > 0.05) continue;  // at 90 degrees
    shift_keV.push_back(std::abs(scatter.photon_keV - scattered_keV(kLine_keV, scatter.cos_angle)));
  }
  const auto middle = shift_keV.begin() + static_cast<std::ptrdiff_t>(shift_keV.size() / 2);
  std::nth_element(shift_keV.begin(), middle, shift_keV.end());
  EXPECT_GT(*middle, 1.0) << "median, keV";
  EXPECT_LT(*middle, 4.0) << "median, keV";
}

// Bound electrons are not reached by small momentum transfers: forward scattering is suppressed, more at low energy.
TEST(SampleCompton, SuppressesForwardScattering) {
  const Atom cadmium = load_atom(48);
  Random random(4);
  const auto mean_cosine = [&](double energy_keV) {
    double sum = 0.0;
    for (int i = 0; i < 20'000; ++i) sum += sample_compton(cadmium, energy_keV, random).cos_angle / 20'000;
    return sum;
  };
  EXPECT_LT(mean_cosine(20.0), -0.1) << "free electrons: near 0";
  EXPECT_GT(mean_cosine(kLine_keV), 0.2);
}

TEST(Rayleigh, IsForwardAtHighEnergyAndThomsonAtLow) {
  Random random(5);
  const auto mean_cosine = [&](double energy_keV) {
    double sum = 0.0;
    for (int i = 0; i < 20'000; ++i) sum += sample_rayleigh(50, energy_keV, random) / 20'000;
    return sum;
  };
  EXPECT_GT(mean_cosine(kLine_keV), 0.99);
  EXPECT_NEAR(mean_cosine(0.1), 0.0, 0.03);
}

TEST(Photoelectron, LeavesForwardWhenFastAndSidewaysWhenSlow) {
  Random random(6);
  const auto mean_cosine = [&](double energy_keV) {
    double sum = 0.0;
    for (int i = 0; i < 50'000; ++i) {
      const double cosine = sample_photoelectron(energy_keV, random);
      EXPECT_TRUE(cosine >= -1.0 && cosine <= 1.0) << cosine;
      sum += cosine / 50'000;
    }
    return sum;
  };
  EXPECT_NEAR(mean_cosine(1.0), 0.05, 0.05) << "sin^2: nearly symmetric";
  EXPECT_GT(mean_cosine(630.0), 0.6);
}

}  // namespace
}  // namespace comptonaut
