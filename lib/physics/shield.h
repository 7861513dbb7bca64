// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "physics/cross_sections.h"

namespace comptonaut {

/// What walls and ground are made of, as photons that pass unscattered know it.
class Shield {
 public:
  /// concrete (2.3 g/cm^3), brick (1.8), soil (1.5), wood (0.64), steel (7.8): mass fractions of NIST's tables of
  /// compounds, soil as dry quartz sand. Throws std::invalid_argument where the name is none of names(),
  /// std::runtime_error where `folder` lacks the data.
  static Shield load(const std::string& name, const std::filesystem::path& folder = kFisxFolder);
  [[nodiscard]] static std::vector<std::string> names();

  /// mu, 1/m: a share exp(-mu d) comes through d metres. Throws std::invalid_argument outside XCOM's energies.
  [[nodiscard]] double attenuation_per_m(double energy_keV) const;

 private:
  struct Component {
    CrossSections cross_sections;
    double mass_fraction;
  };
  double density_g_cm3_ = 0.0;
  std::vector<Component> components_;
};

}  // namespace comptonaut
