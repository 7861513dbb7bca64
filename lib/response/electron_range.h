// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace comptonaut {

/// Length of an electron's track in CdTe, um  [Kanaya and Okayama 1972]: 0.0276 A E^1.67 / (Z^0.889 rho) with A =
/// 120.0, Z = 50, rho = 5.85 g/cm^3. Within 15 % of ESTAR's continuous-slowing-down range from 50 to 600 keV.
[[nodiscard]] double electron_range_um(double energy_keV);

/// The inverse: energy of an electron that has this much of its track before it.
[[nodiscard]] double energy_of_range_keV(double range_um);

/// Root mean square of the angle, in a plane, by which an electron turns within this length of CdTe  [Highland 1975, as
/// in the Review of Particle Physics]; radiation length 15.2 mm.
[[nodiscard]] double multiple_scattering_rad(double energy_keV, double length_um);

}  // namespace comptonaut
