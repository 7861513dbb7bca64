// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "core/random.h"
#include "physics/atom.h"

namespace comptonaut {

/// A photon scattered at a bound, moving electron. The electron's kinetic energy is E - photon_keV - binding.
struct ComptonScatter {
  double cos_angle = 1.0;
  double photon_keV = 0.0;
  std::size_t shell = 0;  ///< of the atom: holds a hole now
};

/// Energy of a photon scattered by this angle at an electron whose momentum along the momentum transfer is
/// momentum_mc (units of m_e c, |momentum_mc| < 1); 0 is Compton's formula  [Brusa et al., NIM A 379 (1996) 167, eq.
/// 6].
[[nodiscard]] double doppler_keV(double energy_keV, double cos_angle, double momentum_mc);

/// Draws angle, shell and scattered energy in the impulse approximation  [Brusa et al. 1996]: Klein-Nishina's angle,
/// a shell by its number of electrons, the electron's momentum by the shell's Compton profile; all three are drawn
/// again where the energy given up would not lift the electron out of its shell, which is what suppresses forward
/// scattering (the incoherent scattering function).
///
/// Profile: that of a full hydrogenic shell with p_0 = sqrt(2 m_e U), J(p) = 8 / (3 pi p_0) (1 + p^2 / p_0^2)^-3
/// [Fock 1935], U the subshell's binding energy of EADL97. Right for the inner shells; the outer ones, which screening
/// binds less than they move, come out narrower than Hartree-Fock's (Biggs et al. 1975). At 662 keV and 90 degrees half
/// of all scattered photons of Te are shifted by more than 3.2 keV, little beside the detector's sigma of 8 keV.
[[nodiscard]] ComptonScatter sample_compton(const Atom& atom, double energy_keV, Random& random);

}  // namespace comptonaut
