// SPDX-License-Identifier: BSD-3-Clause
#include "physics/atom.h"

#include <gtest/gtest.h>

#include <numeric>
#include <stdexcept>

namespace comptonaut {
namespace {

TEST(Atom, HoldsAsManyElectronsAsProtons) {
  for (const int z : {7, 8, 18, 48, 52}) {
    const Atom atom = load_atom(z);
    double electrons = 0.0;
    for (const Shell& shell : atom.shells) electrons += shell.electrons;
    EXPECT_EQ(electrons, z);
    EXPECT_EQ(atom.shells.front().electrons, 2.0) << "K of Z = " << z;
  }
}

TEST(Atom, HasTheKnownKShellsOfCadmiumAndTellurium) {
  const Atom cadmium = load_atom(48), tellurium = load_atom(52);
  EXPECT_NEAR(cadmium.shells.front().binding_keV, 26.71, 0.05);
  EXPECT_NEAR(tellurium.shells.front().binding_keV, 31.81, 0.05);
  EXPECT_NEAR(cadmium.fluorescence_yield_k(), 0.8434, 0.001);
  EXPECT_NEAR(tellurium.fluorescence_yield_k(), 0.8787, 0.001);
  const auto strongest = [](const Atom& atom) {
    return std::max_element(atom.k_x_rays.begin(), atom.k_x_rays.end(),
                            [](const XRayLine& a, const XRayLine& b) { return a.probability < b.probability; })
        ->energy_keV;
  };
  EXPECT_NEAR(strongest(cadmium), 23.17, 0.05) << "K alpha 1";
  EXPECT_NEAR(strongest(tellurium), 27.47, 0.05) << "K alpha 1";
}

TEST(Atom, NamesWhatIsMissing) {
  EXPECT_THROW(static_cast<void>(load_atom(48, "/nonexistent")), std::runtime_error);
  EXPECT_THROW(static_cast<void>(load_atom(200)), std::runtime_error);
}

}  // namespace
}  // namespace comptonaut
