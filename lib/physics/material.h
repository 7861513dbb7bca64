// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "physics/atom.h"
#include "physics/cross_sections.h"

namespace comptonaut {

/// A mixture of elements.
struct Material {
  struct Component {
    Atom atom;
    CrossSections cross_sections;
    double mass_fraction = 0.0;
  };

  double density_g_cm3 = 0.0;
  std::vector<Component> components;

  /// Linear attenuation coefficients, 1/m. Throws std::invalid_argument outside XCOM's energies.
  [[nodiscard]] Coefficients attenuation_per_m(double energy_keV) const;
};

/// The sensor: Cd and Te in equal number, 5.85 g/cm^3. Throws std::runtime_error if `folder` lacks the data.
[[nodiscard]] Material load_cdte(const std::filesystem::path& folder = kFisxFolder);

/// Dry air near the ground at 20 degrees C and 1013 hPa: 1.2048e-3 g/cm^3, mass fractions of N, O and Ar as NIST's.
[[nodiscard]] Material load_air(const std::filesystem::path& folder = kFisxFolder);

}  // namespace comptonaut
