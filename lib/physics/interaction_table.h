// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "core/random.h"
#include "physics/material.h"

namespace comptonaut {

/// A material's attenuation on a fine logarithmic grid of energies, 1 keV to 3 MeV, made for many draws: 0.2 % from
/// entry to entry, linear between them. Absorption edges are smeared by as much, elsewhere the error is below 1e-4.
class InteractionTable {
 public:
  static constexpr double kMin_keV = 1.0;
  static constexpr double kMax_keV = 3000.0;

  explicit InteractionTable(const Material& material);

  /// Place of an energy in the table; domain [kMin_keV, kMax_keV].
  struct Place {
    std::size_t node = 0;
    double fraction = 0.0;  ///< towards the next node
  };
  [[nodiscard]] static Place place(double energy_keV);

  /// Total attenuation, 1/m.
  [[nodiscard]] double attenuation_per_m(const Place& place) const;

  struct Choice {
    Process process = Process::kPhotoelectric;
    std::size_t component = 0;
  };
  /// By what, and at which component of the material, a photon interacts.
  [[nodiscard]] Choice sample(const Place& place, Random& random) const;

 private:
  std::size_t choices_;             // processes x components
  std::vector<double> cumulative_;  // per node: running sum over the choices, 1/m
};

}  // namespace comptonaut
