// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "core/random.h"

namespace comptonaut {

/// A unit vector at this angle to `direction`, all around it with equal chance.
[[nodiscard]] Eigen::Vector3d deflect(const Eigen::Vector3d& direction, double cos_angle, Random& random);

/// Cosine of a Rayleigh scatter angle: Thomson's (1 + cos^2) times the squared form factor of an exponentially screened
/// nucleus, F(q) = Z / (1 + (q a)^2), a = 0.885 a_0 Z^(-1/3)  [Thomas and Fermi]. Its mean angle is right to some 10 to
/// 20 %; at 662 keV, where Rayleigh is 4 % of all interactions and turns photons by 2 degrees, that is nothing.
[[nodiscard]] double sample_rayleigh(int z, double energy_keV, Random& random);

/// Cosine of the angle between a photon and the K electron that it ejects with this kinetic energy  [Sauter 1931,
/// sampled as in PENELOPE, NEA/MBDAV/R(2019)1, section 2.2.1].
[[nodiscard]] double sample_photoelectron(double electron_keV, Random& random);

}  // namespace comptonaut
