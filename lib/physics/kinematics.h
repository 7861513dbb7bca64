// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

namespace comptonaut {

inline constexpr double kElectronMass_keV = 510.99895;  ///< m_e c^2, CODATA 2018

/// Energy left to a photon of energy_keV that scatters at a free electron at rest by an angle of this cosine,
///   E' = E / (1 + E / (m_e c^2) (1 - cos))                                                          [Compton 1923]
[[nodiscard]] double scattered_keV(double energy_keV, double cos_angle);

/// Most that a free electron can take from a photon: that of backscatter. For 661.657 keV: 477.3.
[[nodiscard]] double compton_edge_keV(double energy_keV);

/// Cosine of the scatter angle of a photon that gave e_electron_keV to a free electron, then e_photon_keV, all that
/// was left:
///   cos(beta) = 1 + m_e c^2 (1/E_0 - 1/E_2),  E_0 = E_1 + E_2                                        [Compton 1923]
/// nullopt: no angle explains the two energies (usual for a photon that escaped in part).
/// Throws std::invalid_argument unless both energies are positive and finite.
[[nodiscard]] std::optional<double> scatter_cosine(double e_electron_keV, double e_photon_keV);

/// Energies of electron and scattered photon.
struct PairEnergies {
  double electron_keV = 0.0;
  double photon_keV = 0.0;
};

/// The most likely true energies if their sum is the line's and the measured ones have these standard deviations
/// (least squares with the constraint E_1 + E_2 = E_0: the missing energy is shared out in proportion to variance).
[[nodiscard]] PairEnergies constrain_to_line(const PairEnergies& measured, const PairEnergies& sigma, double line_keV);

/// scatter_cosine of a photon of known energy: the two deposits are first constrained to the line. Both sigma zero:
/// the photon's energy is left alone and E_0 is the line's.
/// nullopt also where a constrained energy is not positive. Throws std::invalid_argument as scatter_cosine does, and
/// for a line or a sigma that is negative or not finite.
[[nodiscard]] std::optional<double> scatter_cosine_of_line(const PairEnergies& measured, const PairEnergies& sigma,
                                                           double line_keV);

}  // namespace comptonaut
