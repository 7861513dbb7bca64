// SPDX-License-Identifier: BSD-3-Clause
#include "response/make_response.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace comptonaut {
namespace {

const Material& cdte() {
  static const Material material = load_cdte();
  return material;
}

Eigen::Vector3d from_angles(double phi_deg, double theta_deg) {
  return direction_D(phi_deg * std::numbers::pi / 180.0, theta_deg * std::numbers::pi / 180.0);
}

/// Every photon digitized, unless thinning says otherwise.
DirectionCounts simulate(const Eigen::Vector3d& u_D, std::int64_t photons, std::uint64_t seed, int thinning = 1) {
  const ResponseConfig config{.thinning = thinning};
  const Transport transport(sensor_block(config.rules.sensor), cdte());
  Random random(seed);
  return PhotonSimulator(config, transport).simulate(u_D, photons, random);
}

/// Value of the table that one count of so many photons stands for.
double value_of_count(const Eigen::Vector3d& u_D, std::int64_t photons) {
  return 0.8499 * solid_angle_sr({}, u_D, 1.0) / (4.0 * std::numbers::pi * static_cast<double>(photons));
}

/// Of counts from as many photons: the same within 4.5 sigma.
bool agree(const Tally& a, const Tally& b) {
  return std::abs(a.sum() - b.sum()) < 4.5 * std::sqrt(static_cast<double>(a.weight2 + b.weight2));
}

TEST(MakeResponse, IsTheSameForAnyNumberOfThreads) {
  ResponseConfig config{.photons = 50'000, .seed = 5, .grid_deg = 90};
  const ResponseTable one = make_response(config, cdte()).table;
  config.threads = 2;
  const ResponseTable two = make_response(config, cdte()).table;
  EXPECT_EQ(one.facts(), two.facts());
  EXPECT_EQ(one.entries(), two.entries());
  config.seed = 6;
  EXPECT_NE(make_response(config, cdte()).table.entries(), one.entries());
}

TEST(MakeResponse, EndsADirectionWhereThePrecisionIsEnoughWhateverTheThreads) {
  ResponseConfig config{
      .photons = 10'000'000, .single_rel_sigma = 0.05, .pair_rel_sigma = 0.2, .grid_deg = 90, .thinning = 4};
  const ResponseTable one = make_response(config, cdte()).table;
  for (const ResponseEntry& entry : one.entries()) {
    EXPECT_LT(entry.single_rel_sigma, 0.05);
    EXPECT_LT(entry.pair_rel_sigma, 0.2);
    EXPECT_GT(std::max(entry.single_rel_sigma / 0.05, entry.pair_rel_sigma / 0.2), 0.2) << "it did end";
  }
  config.threads = 3;
  EXPECT_EQ(make_response(config, cdte()).table.entries(), one.entries());
}

TEST(MakeResponse, CoversTheSphereWithTheBlocksSymmetries) {
  const ResponseTable table = make_response({.photons = 2000, .threads = 2, .grid_deg = 30}, cdte()).table;
  EXPECT_EQ(table.entries().size(), 2u + 5u * 12u);
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d u_D = random.unit_vector();
    const Eigen::Vector3d turned_D(-u_D.y(), u_D.x(), u_D.z()), mirrored_D(u_D.y(), u_D.x(), u_D.z());
    EXPECT_EQ(table.single(u_D), table.single(turned_D)) << u_D.transpose();
    EXPECT_EQ(table.pair(u_D), table.pair(mirrored_D)) << u_D.transpose();
  }
}

// The symmetries that the table takes for granted: directions that they map on each other, simulated apart.
TEST(MakeResponse, SymmetricDirectionsAgreeWithinErrors) {
  constexpr std::int64_t kPhotons = 50'000;
  const DirectionCounts reference = simulate(from_angles(20, 60), kPhotons, 1);
  std::uint64_t seed = 2;
  for (const double phi_deg : {70.0, 110.0, 200.0, -20.0}) {
    const DirectionCounts other = simulate(from_angles(phi_deg, 60), kPhotons, seed++);
    EXPECT_TRUE(agree(reference.singles, other.singles)) << phi_deg << ": " << other.singles.weight;
    EXPECT_TRUE(agree(reference.pairs, other.pairs)) << phi_deg << ": " << other.pairs.weight;
    EXPECT_TRUE(agree(reference.others, other.others)) << phi_deg << ": " << other.others.weight;
  }
}

TEST(MakeResponse, HasTheRoughValuesOfOtherMonteCarlos) {
  const Eigen::Vector3d face_on_D = Eigen::Vector3d::UnitZ();
  const DirectionCounts counts = simulate(face_on_D, 400'000, 3);
  const double value = value_of_count(face_on_D, counts.photons);
  EXPECT_NEAR(value * static_cast<double>(counts.interacted), 1.1e-6, 0.1e-6) << "events of any kind";
  EXPECT_NEAR(value * counts.pairs.sum(), 3.3e-8, 0.6e-8);
  EXPECT_EQ(static_cast<double>(counts.simulated_pairs.size()), counts.pairs.sum());
}

// Thinning spares work and changes no expectation: against the analogue simulation, in several directions.
TEST(MakeResponse, ThinnedPhotonsCountAsTheAnalogueOnes) {
  constexpr std::int64_t kPhotons = 200'000;
  std::uint64_t seed = 20;
  for (const double theta_deg : {0.0, 50.0, 90.0, 130.0}) {
    const DirectionCounts analogue = simulate(from_angles(30, theta_deg), kPhotons, seed++);
    for (const int thinning : {4, 16}) {
      const DirectionCounts thinned = simulate(from_angles(30, theta_deg), kPhotons, seed++, thinning);
      EXPECT_TRUE(agree(analogue.singles, thinned.singles)) << theta_deg;
      EXPECT_TRUE(agree(analogue.pairs, thinned.pairs)) << theta_deg;
      EXPECT_TRUE(agree(analogue.others, thinned.others)) << theta_deg;
      EXPECT_LT(thinned.pairs.rel_sigma(kPhotons), 1.2 * analogue.pairs.rel_sigma(kPhotons)) << theta_deg;
    }
  }
}

// The same for a window that most photons miss.
TEST(MakeResponse, ThinnedPhotonsOutsideTheWindowCountAsTheAnalogueOnes) {
  constexpr std::int64_t kPhotons = 300'000;
  const auto singles = [](int thinning, std::uint64_t seed) {
    const NuclideChannel peak{.singles_min_keV = 560.0, .singles_max_keV = 700.0};
    const ResponseConfig config{.rules = {.channels = {peak}}, .thinning = thinning};
    const Transport transport(sensor_block(config.rules.sensor), cdte());
    Random random(seed);
    return PhotonSimulator(config, transport).simulate(from_angles(10, 70), kPhotons, random).singles;
  };
  const Tally analogue = singles(1, 31), thinned = singles(2, 32);
  EXPECT_TRUE(agree(analogue, thinned)) << analogue.weight << " " << thinned.weight;
  EXPECT_GT(analogue.weight, 500);
}

// A nuclide's lines together give what they give one by one, weighted by their photons per decay.
TEST(MakeResponse, AddsUpTheLinesOfANuclide) {
  constexpr std::int64_t kPhotons = 200'000;
  const auto singles = [&](std::vector<GammaLine> lines, std::uint64_t seed) {
    const ResponseConfig config{.rules = {.channels = {{.emissions = std::move(lines)}}}, .thinning = 1};
    const Transport transport(sensor_block(config.rules.sensor), cdte());
    Random random(seed);
    return PhotonSimulator(config, transport).simulate(from_angles(10, 70), kPhotons, random).singles.sum();
  };
  const double low = singles({{.energy_keV = 150.0, .per_decay = 1.0}}, 1);
  const double high = singles({{.energy_keV = 600.0, .per_decay = 1.0}}, 2);
  const double both = singles({{.energy_keV = 150.0, .per_decay = 0.2}, {.energy_keV = 600.0, .per_decay = 0.6}}, 3);
  EXPECT_NEAR(both, 0.25 * low + 0.75 * high, 4.5 * std::sqrt(2.0 * both));
  EXPECT_GT(low, 1.5 * high);
}

TEST(MakeResponse, ConesPassByObliqueSources) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  for (const double angle_deg : {30.0, 45.0, 60.0}) {
    const AngularSummary summary = summarize(simulate(from_angles(angle_deg, angle_deg), 150'000, 4).simulated_pairs);
    EXPECT_GT(summary.pairs, 200) << angle_deg;
    EXPECT_LT(summary.best_median_rad, 4.0 * kDegree) << angle_deg;
    EXPECT_LT(summary.true_median_rad, 4.0 * kDegree) << angle_deg;
    EXPECT_NEAR(summary.a_is_true, 0.55, 0.15) << angle_deg;
    EXPECT_GT(summary.has_truth, 0.98) << angle_deg;
  }
}

TEST(MakeResponse, NamesWhatIsWrongWithItsConfiguration) {
  const auto refused = [](const ResponseConfig& config) {
    EXPECT_THROW(static_cast<void>(make_response(config, cdte())), std::invalid_argument);
  };
  refused({.photons = 0});
  refused({.threads = 0});
  refused({.grid_deg = 7});
  refused({.thinning = 0});
  refused({.single_rel_sigma = -0.1});
  refused({.rules = {.channels = {{.emissions = {{.energy_keV = 0.1, .per_decay = 1.0}}}}}});
  refused({.rules = {.channels = {}}});
  refused({.rules = {.channels = {{.line_keV = 5000.0}}}});
}

}  // namespace
}  // namespace comptonaut
