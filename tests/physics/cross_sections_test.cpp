// SPDX-License-Identifier: BSD-3-Clause
#include "physics/cross_sections.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

#include "core/random.h"
#include "physics/interaction_table.h"
#include "physics/klein_nishina.h"
#include "physics/line.h"
#include "physics/material.h"
#include "scratch.h"

namespace comptonaut {
namespace {

TEST(CrossSections, AreXcomsAtItsEnergiesAndBetweenThem) {
  const CrossSections cadmium = CrossSections::load(48);
  const Coefficients at = cadmium.at(500.0);
  EXPECT_DOUBLE_EQ(at.of(Process::kRayleigh), 4.634000e-3);
  EXPECT_DOUBLE_EQ(at.of(Process::kCompton), 7.344800e-2);
  EXPECT_DOUBLE_EQ(at.of(Process::kPhotoelectric), 1.441600e-2);
  EXPECT_EQ(at.of(Process::kPair), 0.0);
  EXPECT_NEAR(cadmium.at(kLine_keV).total(), 0.075384, 2e-6) << "cm^2/g, by hand between 650 and 750 keV";
  EXPECT_THROW(static_cast<void>(cadmium.at(0.05)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(cadmium.at(1e12)), std::invalid_argument);
}

TEST(CrossSections, JumpAtTheKEdge) {
  const CrossSections cadmium = CrossSections::load(48);
  EXPECT_DOUBLE_EQ(cadmium.k_edge_keV(), 26.711);
  EXPECT_NEAR(cadmium.k_shell_share(), 1.0 - 7.9287 / 49.763, 1e-12);
  EXPECT_NEAR(cadmium.at(26.711 - 1e-9).of(Process::kPhotoelectric), 7.9287, 1e-6);
  EXPECT_NEAR(cadmium.at(26.711).of(Process::kPhotoelectric), 49.763, 1e-6) << "the edge counts as above";
}

// Above 300 keV electrons are as good as free: Compton per gram is Klein-Nishina times electrons per gram.
TEST(CrossSections, ComptonApproachesFreeElectrons) {
  const CrossSections cadmium = CrossSections::load(48);
  const double electrons_per_g = 48 * 6.02214076e23 / 112.414;
  EXPECT_NEAR(cadmium.at(kLine_keV).of(Process::kCompton) / (1e4 * klein_nishina_m2(kLine_keV) * electrons_per_g), 1.0,
              0.02);
}

TEST(Material, CdTeAndAirAttenuateAsPublished) {
  EXPECT_NEAR(load_cdte().attenuation_per_m(kLine_keV).total(), 43.84, 0.05) << "1/m: 0.0749 cm^2/g, 5.85 g/cm^3";
  EXPECT_NEAR(load_air().attenuation_per_m(kLine_keV).total(), 0.0093, 0.00005) << "1/m";
  EXPECT_GT(load_cdte().attenuation_per_m(1332.5).of(Process::kPair), 0.0);
}

TEST(InteractionTable, IsTheMaterialsAttenuation) {
  const Material cdte = load_cdte();
  const InteractionTable table(cdte);
  for (const double energy_keV : {1.0, 5.0, 23.1, 27.3, 31.0, 60.0, 184.3, kLine_keV, 1100.0, 2999.9, 3000.0}) {
    const double exact = cdte.attenuation_per_m(energy_keV).total();
    EXPECT_NEAR(table.attenuation_per_m(InteractionTable::place(energy_keV)) / exact, 1.0, 1e-4)
        << energy_keV << " keV";
  }
}

TEST(InteractionTable, DrawsProcessesAndElementsInProportion) {
  constexpr int kDraws = 200'000;
  const Material cdte = load_cdte();
  const InteractionTable table(cdte);
  Random random(5);
  for (const double energy_keV : {28.0, 150.0, kLine_keV, 2500.0}) {
    std::array<std::array<int, kProcesses>, 2> seen{};
    for (int i = 0; i < kDraws; ++i) {
      const auto choice = table.sample(InteractionTable::place(energy_keV), random);
      ++seen[choice.component][static_cast<std::size_t>(choice.process)];
    }
    const double total = cdte.attenuation_per_m(energy_keV).total();
    for (std::size_t c = 0; c < 2; ++c) {
      for (std::size_t p = 0; p < kProcesses; ++p) {
        const Material::Component& part = cdte.components[c];
        const double share =
            100.0 * cdte.density_g_cm3 * part.mass_fraction * part.cross_sections.at(energy_keV).value[p] / total;
        EXPECT_NEAR(seen[c][p], kDraws * share, 5.0 * std::sqrt(kDraws * share) + 1.0)
            << energy_keV << " keV, component " << c << ", process " << p;
      }
    }
  }
}

class BrokenFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void write(const std::string& text) const { std::ofstream(folder_ / "XCOM_CrossSections.dat") << text; }
  std::string message() const {
    try {
      CrossSections::load(48, folder_);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "no error";
  }
  std::filesystem::path folder_ = scratch_folder();
};

TEST_F(BrokenFiles, AreNamedWithTheReason) {
  const std::string header =
      "#S 48 Cd\n#L PhotonEnergy[keV] Rayleigh(coherent)[cm2/g] Compton(incoherent)[cm2/g] "
      "Photoelectric[cm2/g] PairProduction[cm2/g]\n";
  EXPECT_NE(message().find("python-fisx-common"), std::string::npos) << message();
  write("nothing");
  EXPECT_NE(message().find("no data of scan 48"), std::string::npos) << message();
  write(header + "1 2 3 4 5\n2 2 3 4\n");
  EXPECT_NE(message().find(".dat:4: 4 numbers, expected 5"), std::string::npos) << message();
  write(header + "1 2 x 4 5\n");
  EXPECT_NE(message().find(".dat:3: 'x' is not a number"), std::string::npos) << message();
  write(header + "2 2 3 4 5\n1 2 3 4 5\n");
  EXPECT_NE(message().find("energies must grow"), std::string::npos) << message();
  write("#S 48 Cd\n#L PhotonEnergy[keV]\n1\n");
  EXPECT_NE(message().find("no column 'Rayleigh"), std::string::npos) << message();
}

TEST_F(BrokenFiles, OfAnyKindGiveOneError) {
  std::string good =
      "#S 48 Cd\n#N 5\n#L PhotonEnergy[keV] Rayleigh(coherent)[cm2/g] Compton(incoherent)[cm2/g] "
      "Photoelectric[cm2/g] PairProduction[cm2/g]\n";
  for (int i = 1; i < 40; ++i) good += std::to_string(i) + " 1.5e-1 2e+0 3.0 0\n";
  Random random(3);
  for (int round = 0; round < 300; ++round) {
    std::string bad = good;
    for (int n = 0; n < 1 + round % 5; ++n) bad[random() % bad.size()] = static_cast<char>(random());
    write(bad.substr(0, random() % (bad.size() + 1)));
    static_cast<void>(message());  // an error or a table, nothing else
  }
}

}  // namespace
}  // namespace comptonaut
