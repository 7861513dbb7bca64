// SPDX-License-Identifier: BSD-3-Clause
#include "physics/material.h"

namespace comptonaut {
namespace {

constexpr double kCadmium_u = 112.414, kTellurium_u = 127.60;  // standard atomic weights, IUPAC 2013

Material::Component component(int z, double mass_fraction, const std::filesystem::path& folder) {
  return {
      .atom = load_atom(z, folder), .cross_sections = CrossSections::load(z, folder), .mass_fraction = mass_fraction};
}

}  // namespace

Coefficients Material::attenuation_per_m(double energy_keV) const {
  Coefficients sum;
  for (const Component& part : components) {
    const Coefficients cm2_g = part.cross_sections.at(energy_keV);
    for (std::size_t p = 0; p < kProcesses; ++p) {
      sum.value[p] += 100.0 * density_g_cm3 * part.mass_fraction * cm2_g.value[p];
    }
  }
  return sum;
}

Material load_cdte(const std::filesystem::path& folder) {
  const double sum_u = kCadmium_u + kTellurium_u;
  return {.density_g_cm3 = 5.85,
          .components = {component(48, kCadmium_u / sum_u, folder), component(52, kTellurium_u / sum_u, folder)}};
}

Material load_air(const std::filesystem::path& folder) {
  return {.density_g_cm3 = 1.2048e-3,
          .components = {component(7, 0.7553, folder), component(8, 0.2318, folder), component(18, 0.0129, folder)}};
}

}  // namespace comptonaut
