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

DirectionCounts simulate(const Eigen::Vector3d& u_D, std::int64_t photons, std::uint64_t seed) {
  const ResponseConfig config;
  const Transport transport(sensor_block(config.rules.sensor), cdte());
  Random random(seed);
  return PhotonSimulator(config, transport).simulate(u_D, photons, random);
}

/// Value of the table that one count of so many photons stands for.
double value_of_count(const Eigen::Vector3d& u_D, std::int64_t photons) {
  return 0.8499 * solid_angle_sr({}, u_D, 1.0) / (4.0 * std::numbers::pi * static_cast<double>(photons));
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
    const auto near = [](std::int64_t a, std::int64_t b) {
      return std::abs(static_cast<double>(a - b)) < 4.5 * std::sqrt(static_cast<double>(a + b));
    };
    EXPECT_TRUE(near(reference.singles, other.singles)) << phi_deg << ": " << other.singles;
    EXPECT_TRUE(near(reference.pairs, other.pairs)) << phi_deg << ": " << other.pairs;
    EXPECT_TRUE(near(reference.others, other.others)) << phi_deg << ": " << other.others;
  }
}

TEST(MakeResponse, HasTheRoughValuesOfOtherMonteCarlos) {
  const Eigen::Vector3d face_on_D = Eigen::Vector3d::UnitZ();
  const DirectionCounts counts = simulate(face_on_D, 400'000, 3);
  const double value = value_of_count(face_on_D, counts.photons);
  EXPECT_NEAR(value * static_cast<double>(counts.interacted), 1.1e-6, 0.1e-6) << "events of any kind";
  EXPECT_NEAR(value * static_cast<double>(counts.pairs), 3.3e-8, 0.6e-8);
  EXPECT_EQ(static_cast<std::int64_t>(counts.angular_errors.size()), counts.pairs);
}

TEST(MakeResponse, ConesPassByObliqueSources) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  for (const double angle_deg : {30.0, 45.0, 60.0}) {
    const AngularSummary summary = summarize(simulate(from_angles(angle_deg, angle_deg), 150'000, 4).angular_errors);
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
  refused({.rules = {.channels = {}}});
  refused({.rules = {.channels = {{.line_keV = 5000.0}}}});
}

TEST(ShippedTable, HasTheStatisticsThatItPromises) {
  const auto table = ResponseTable::load(COMPTONAUT_SOURCE_DIR "/config/response/cs-137.csv");
  EXPECT_EQ(table.facts().at("nuclide"), "Cs-137");
  for (const ResponseEntry& entry : table.entries()) {
    EXPECT_LT(entry.single_rel_sigma, 0.01) << entry.phi_rad << " " << entry.theta_rad;
    EXPECT_LT(entry.pair_rel_sigma, 0.03) << entry.phi_rad << " " << entry.theta_rad;
  }
}

// The shipped table is of this detector model and these rules: a direction simulated anew agrees.
TEST(ShippedTable, IsWhatTheMonteCarloGives) {
  const auto table = ResponseTable::load(COMPTONAUT_SOURCE_DIR "/config/response/cs-137.csv");
  for (const Eigen::Vector3d& u_D : {from_angles(40, 50), from_angles(0, 180), from_angles(100, 90)}) {
    const DirectionCounts counts = simulate(u_D, 50'000, 9);
    const double value = value_of_count(u_D, counts.photons);
    const auto singles = static_cast<double>(counts.singles), pairs = static_cast<double>(counts.pairs);
    EXPECT_NEAR(table.single(u_D) / value, singles, 5.0 * std::sqrt(singles)) << u_D.transpose();
    EXPECT_NEAR(table.pair(u_D) / value, pairs, 5.0 * std::sqrt(pairs)) << u_D.transpose();
  }
}

}  // namespace
}  // namespace comptonaut
