// SPDX-License-Identifier: BSD-3-Clause
#include "physics/shield.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace comptonaut {
namespace {

// NIST's tables of X-ray mass attenuation coefficients (NISTIR 5632), cm^2/g at 600 and 800 keV.
TEST(Shield, AttenuatesAsNistTells) {
  EXPECT_NEAR(Shield::load("concrete").attenuation_per_m(600.0), 230.0 * 8.236e-2, 0.01 * 230.0 * 8.236e-2);
  EXPECT_NEAR(Shield::load("concrete").attenuation_per_m(800.0), 230.0 * 7.227e-2, 0.01 * 230.0 * 7.227e-2);
  EXPECT_NEAR(Shield::load("steel").attenuation_per_m(600.0), 780.0 * 7.704e-2, 0.01 * 780.0 * 7.704e-2);
}

TEST(Shield, EachMaterialLetsMoreThroughAtHigherEnergies) {
  for (const std::string& name : Shield::names()) {
    const Shield shield = Shield::load(name);
    EXPECT_GT(shield.attenuation_per_m(662.0), 4.0) << name;
    EXPECT_GT(shield.attenuation_per_m(662.0), shield.attenuation_per_m(1332.0)) << name;
  }
}

TEST(Shield, IsRefusedByAnotherName) {
  try {
    (void)Shield::load("cheese");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(std::string(error.what()), "material 'cheese' must be one of concrete, brick, soil, wood, steel");
  }
}

}  // namespace
}  // namespace comptonaut
