// SPDX-License-Identifier: BSD-3-Clause
#include "physics/transport.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "physics/kinematics.h"
#include "physics/line.h"

namespace comptonaut {
namespace {

constexpr double kFar_m = std::numeric_limits<double>::infinity();

Eigen::Vector3d from_angles(double phi_deg, double theta_deg) {
  const double phi = phi_deg * std::numbers::pi / 180.0, theta = theta_deg * std::numbers::pi / 180.0;
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

const Material& cdte() {
  static const Material material = load_cdte();
  return material;
}

TEST(Transport, ConservesEnergyAndStaysInTheBlock) {
  const Transport transport({}, cdte());
  Random random(1);
  for (const double energy_keV : {3.0, 12.0, 40.0, 184.3, kLine_keV, 1332.5, 2900.0}) {
    for (int i = 0; i < 20'000; ++i) {
      const Eigen::Vector3d u_D = random.unit_vector();
      const Photon photon = sample_entry(transport.block(), u_D, kFar_m, energy_keV, random);
      const PhotonHistory history = transport.follow(photon, random);
      double sum_keV = history.escaped_keV;
      for (const Deposit& deposit : history.deposits) {
        ASSERT_GT(deposit.energy_keV, 0.0);
        ASSERT_TRUE(Block{}.contains(deposit.p_D)) << deposit.p_D.transpose();
        sum_keV += deposit.energy_keV;
      }
      ASSERT_NEAR(sum_keV, energy_keV, 1e-9 * energy_keV) << "photon " << i;
    }
  }
}

TEST(Transport, RefusesEnergiesBeyondItsTable) {
  const Transport transport({}, cdte());
  Random random(1);
  for (const double energy_keV : {0.5, 3001.0, std::nan("")}) {
    EXPECT_THROW(static_cast<void>(transport.follow({.energy_keV = energy_keV}, random)), std::invalid_argument);
  }
}

/// Share of photons from u_D that leave energy in the block.
double simulated_share(const Eigen::Vector3d& u_D, int photons) {
  const Transport transport({}, cdte());
  Random random(7);
  int hit = 0;
  for (int i = 0; i < photons; ++i) {
    const Photon photon = sample_entry(transport.block(), u_D, kFar_m, kLine_keV, random);
    hit += transport.follow(photon, random).deposits.empty() ? 0 : 1;
  }
  return static_cast<double>(hit) / photons;
}

/// Attenuation but for Rayleigh scattering, which leaves nothing and at 662 keV hardly turns a photon.
double absorbing_per_m() {
  const Coefficients mu = cdte().attenuation_per_m(kLine_keV);
  return mu.total() - mu.of(Process::kRayleigh);
}

// A beam across the y axis meets a rectangle L x d: a middle part of chord c = d / cos, and two edges where the chord
// grows from 0 to c.
double closed_form_share(double theta_rad) {
  const double length_m = 14.08e-3, depth_m = 2e-3, mu = absorbing_per_m();
  const double c = depth_m / std::cos(theta_rad);
  const double middle_m = length_m * std::cos(theta_rad) - depth_m * std::sin(theta_rad);
  const double edge_m = depth_m * std::sin(theta_rad);
  const double full = 1.0 - std::exp(-mu * c);
  return (middle_m * full + 2.0 * edge_m * (1.0 - full / (mu * c))) / (middle_m + 2.0 * edge_m);
}

TEST(FirstInteraction, HasTheClosedFormsProbabilityFaceOnAndOblique) {
  constexpr int kPhotons = 400'000;
  for (const double theta_deg : {0.0, 30.0, 60.0, 75.0}) {
    const double expected = closed_form_share(theta_deg * std::numbers::pi / 180.0);
    const double sigma = std::sqrt(expected * (1.0 - expected) / kPhotons);
    for (const double phi_deg : {0.0, 90.0, 180.0}) {
      EXPECT_NEAR(simulated_share(from_angles(phi_deg, theta_deg), kPhotons), expected, 4.5 * sigma)
          << "phi " << phi_deg << ", theta " << theta_deg;
    }
  }
}

// Any direction: the shadow is integrated over a grid of rays, each cut with the box by itself.
TEST(FirstInteraction, MatchesASlowIntegralInAnyDirection) {
  const Eigen::Vector3d u_D = from_angles(30.0, 120.0), half_m(7.04e-3, 7.04e-3, 1e-3);
  const Eigen::Vector3d e1 = u_D.unitOrthogonal(), e2 = u_D.cross(e1);
  constexpr int kRays = 600;
  constexpr double kReach_m = 11e-3;
  double hit = 0.0, absorbed = 0.0;
  for (int i = 0; i < kRays; ++i) {
    for (int j = 0; j < kRays; ++j) {
      const Eigen::Vector3d p_D = kReach_m * ((2 * i + 1.0 - kRays) / kRays * e1 + (2 * j + 1.0 - kRays) / kRays * e2);
      double from = -1.0, to = 1.0;
      for (int axis = 0; axis < 3; ++axis) {
        const double a = (-half_m[axis] - p_D[axis]) / u_D[axis], b = (half_m[axis] - p_D[axis]) / u_D[axis];
        from = std::max(from, std::min(a, b));
        to = std::min(to, std::max(a, b));
      }
      if (to <= from) continue;
      hit += 1.0;
      absorbed += 1.0 - std::exp(-absorbing_per_m() * (to - from));
    }
  }
  const double ray_m2 = std::pow(2.0 * kReach_m / kRays, 2);
  EXPECT_NEAR(Block{}.projected_area_m2(u_D) / (hit * ray_m2), 1.0, 2e-3);
  constexpr int kPhotons = 400'000;
  const double expected = absorbed / hit;
  EXPECT_NEAR(simulated_share(u_D, kPhotons), expected, 4.5 * std::sqrt(expected / kPhotons));
}

// 60 keV deep inside a large block: the first electron tells the shell, what stays beside it tells whether an X-ray
// left.
TEST(Fluorescence, HasItsYieldAndItsShareOfAbsorptions) {
  const Transport transport({.half_m = Eigen::Vector3d::Constant(1.0)}, cdte());
  Random random(9);
  for (const Material::Component& component : cdte().components) {
    const double binding_keV = component.atom.shells.front().binding_keV;
    int k_shell = 0, x_rays = 0;
    for (int i = 0; i < 100'000; ++i) {
      const auto deposits = transport.follow({.energy_keV = 60.0}, random).deposits;
      const bool photoelectric = deposits.front().process == Process::kPhotoelectric;
      if (!photoelectric || std::abs(deposits.front().energy_keV - (60.0 - binding_keV)) > 1e-9) continue;
      ++k_shell;
      x_rays += deposits[1].energy_keV < binding_keV - 1.0;
    }
    const double yield = component.atom.fluorescence_yield_k();
    EXPECT_NEAR(x_rays, k_shell * yield, 5.0 * std::sqrt(k_shell * yield * (1.0 - yield))) << "Z " << component.atom.z;
    const double photo_per_m = 100.0 * cdte().density_g_cm3 * component.mass_fraction *
                               component.cross_sections.at(60.0).of(Process::kPhotoelectric);
    const double mu = cdte().attenuation_per_m(60.0).total() - cdte().attenuation_per_m(60.0).of(Process::kRayleigh);
    const double expected = 100'000 * photo_per_m / mu * component.cross_sections.k_shell_share();
    EXPECT_NEAR(k_shell, expected, 5.0 * std::sqrt(expected)) << "Z " << component.atom.z;
  }
}

TEST(PairProduction, SharesOutTheKineticEnergyAndMakesTwoQuanta) {
  const Transport transport({}, cdte());
  Random random(10);
  int pairs = 0, both_escaped = 0;
  for (int i = 0; i < 200'000; ++i) {
    const PhotonHistory history = transport.follow({.p_D = {0, 0, 1e-3}, .energy_keV = 2614.5}, random);
    if (history.deposits.empty() || history.deposits.front().process != Process::kPair) continue;
    ++pairs;
    EXPECT_NEAR(history.deposits[0].energy_keV + history.deposits[1].energy_keV, 2614.5 - 2 * kElectronMass_keV, 1e-9);
    both_escaped += std::abs(history.escaped_keV - 2 * kElectronMass_keV) < 1e-9;
  }
  EXPECT_GT(pairs, 500);
  EXPECT_GT(both_escaped, pairs / 2) << "2 mm of CdTe stop few quanta";
}

TEST(SampleEntry, LiesOnTheSurfaceAndFliesFromTheSource) {
  Random random(3);
  for (int i = 0; i < 10'000; ++i) {
    const Eigen::Vector3d u_D = random.unit_vector();
    const Photon photon = sample_entry({}, u_D, 2.0, kLine_keV, random);
    EXPECT_NEAR((photon.p_D.cwiseAbs().array() / Block{}.half_m.array()).maxCoeff(), 1.0, 1e-12);
    EXPECT_NEAR((photon.p_D - 2.0 * u_D).normalized().dot(photon.flight_D), 1.0, 1e-12);
    const Photon parallel = sample_entry({}, u_D, kFar_m, kLine_keV, random);
    EXPECT_LT((parallel.flight_D + u_D).norm(), 1e-12);
    EXPECT_GT(Block{}.distance_to_exit_m(parallel.p_D, parallel.flight_D), 0.0);
  }
}

}  // namespace
}  // namespace comptonaut
