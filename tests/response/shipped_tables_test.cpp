// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "config/config.h"
#include "response/cone_density.h"
#include "response/make_response.h"

namespace comptonaut {
namespace {

const std::filesystem::path kConfig = COMPTONAUT_SOURCE_DIR "/config";

NuclideChannel channel_of(const std::string& file) {
  return load_config(kConfig / "nuclides" / (file + ".yaml"), read_nuclide_channel);
}

class ShippedTables : public ::testing::TestWithParam<const char*> {
 protected:
  const std::string name_ = std::filesystem::path(GetParam()).filename();
  const NuclideChannel channel_ = channel_of(GetParam());
  const ResponseTable table_ = ResponseTable::load(kConfig / "response" / (name_ + ".csv"));
  const bool down_scatter_ = name_ != GetParam();  ///< what one nuclide leaves in the channel of another
};

TEST_P(ShippedTables, AreOfTheirNuclideAndSayHowTheyWereMade) {
  EXPECT_EQ(table_.facts().at("nuclide"), channel_.name);
  EXPECT_NE(table_.facts().at("command").find(std::string("config/nuclides/") + GetParam()), std::string::npos);
  EXPECT_EQ(table_.entries().size(), 2u + 17u * 36u);
}

TEST_P(ShippedTables, HaveTheStatisticsThatTheyPromise) {
  for (const ResponseEntry& entry : table_.entries()) {
    EXPECT_LT(entry.single_rel_sigma, 0.01) << entry.phi_rad << " " << entry.theta_rad;
    if (channel_.pairs) {
      EXPECT_LT(entry.pair_rel_sigma, 0.03) << entry.phi_rad << " " << entry.theta_rad;
    } else {
      EXPECT_EQ(entry.pair, 0.0);
    }
  }
}

// The shipped table is of this detector model and these rules: a direction simulated anew agrees.
TEST_P(ShippedTables, AreWhatTheMonteCarloGives) {
  constexpr std::int64_t kPhotons = 100'000;
  // Photons that are seldom a pair by themselves are most of what scatters down: thinned, a few of large weight.
  const ResponseConfig config{.rules = {.channels = {channel_}}, .thinning = down_scatter_ ? 1 : 4};
  const Transport transport(sensor_block(config.rules.sensor), load_cdte());
  double per_decay = 0.0;
  for (const GammaLine& line : emitted_lines(channel_)) per_decay += line.per_decay;
  Random random(9);
  for (const double theta_deg : {50.0, 90.0, 180.0}) {
    const Eigen::Vector3d u_D = direction_D(40.0 * std::numbers::pi / 180.0, theta_deg * std::numbers::pi / 180.0);
    const DirectionCounts counts = PhotonSimulator(config, transport).simulate(u_D, kPhotons, random);
    const double photons =
        kPhotons * 4.0 * std::numbers::pi / (per_decay * solid_angle_sr(transport.block(), u_D, 1.0));
    const double singles = photons * table_.single(u_D), pairs = photons * table_.pair(u_D);
    EXPECT_NEAR(counts.singles.sum(), singles, 5.0 * std::sqrt(8.0 * singles) + 0.03 * singles) << theta_deg;
    EXPECT_NEAR(counts.pairs.sum(), pairs, 5.0 * std::sqrt(2.0 * pairs) + 0.03 * pairs) << theta_deg;
  }
}

TEST_P(ShippedTables, HaveADensityOfTheirCones) {
  const auto file = kConfig / "response" / (name_ + "-cones.csv");
  EXPECT_EQ(std::filesystem::exists(file), channel_.pairs);
  if (!channel_.pairs) return;
  const auto density = ConeDensity::load(file);
  EXPECT_EQ(density.facts().at("nuclide"), channel_.name);
  EXPECT_EQ(density.facts().at("command"), table_.facts().at("command"));
}

INSTANTIATE_TEST_SUITE_P(Nuclides, ShippedTables,
                         ::testing::Values("cs-137", "co-60", "co-60-1332", "ir-192", "ir-192-468", "ba-133", "i-131",
                                           "am-241", "down-scatter/co-60-1332-in-cs-137"));

TEST(ShippedNuclides, OfOneSourceCanBeCountedAtTheSameTime) {
  for (const auto& [one, other] : {std::pair("co-60", "co-60-1332"), std::pair("ir-192", "ir-192-468")}) {
    const NuclideChannel low = channel_of(one), high = channel_of(other);
    EXPECT_NO_THROW(check(std::vector{low, high}));
    EXPECT_EQ(low.emissions, high.emissions);
    EXPECT_LT(low.line_keV * (1.0 + low.pair_sum_rel_window), high.line_keV * (1.0 - high.pair_sum_rel_window));
  }
}

// The core widens with the cone's angle: d(beta) / d(E) grows.
TEST(ShippedConeDensity, HasANarrowCoreThatWidensWithTheAngle) {
  const auto density = ConeDensity::load(kConfig / "response/cs-137-cones.csv");
  double before = 1e9;
  for (const double beta_deg : {50.0, 90.0, 120.0, 150.0}) {
    const double peak = density.profile(std::cos(beta_deg * std::numbers::pi / 180.0), Readings::kBoth).per_rad(0.0);
    EXPECT_LT(peak, before) << beta_deg;
    before = peak;
  }
}

}  // namespace
}  // namespace comptonaut
