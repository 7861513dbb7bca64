// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/random.h"

namespace comptonaut {

inline constexpr double kElectronRadius_m = 2.8179403262e-15;  ///< classical, CODATA 2018

/// Cross section of a free electron at rest per steradian, unpolarised photons, m^2/sr  [Klein and Nishina 1929]:
///   r_e^2 / 2 P^2 (P + 1/P - sin^2),  P = E'/E
[[nodiscard]] double klein_nishina_m2_sr(double energy_keV, double cos_angle);

/// The same over all directions, m^2 (closed form, relative error below 1e-9 from 1 keV to 100 MeV).
[[nodiscard]] double klein_nishina_m2(double energy_keV);

/// Cosine of a scatter angle drawn from the differential cross section (composition and rejection, Butcher and
/// Messel 1960).
[[nodiscard]] double sample_klein_nishina(double energy_keV, Random& random);

}  // namespace comptonaut
