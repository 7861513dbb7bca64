// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>

namespace comptonaut {

/// The CdTe block over the chip and what it does to time and energy. The same numbers read real hits and make
/// simulated ones.
struct SensorConfig {
  double thickness_um = 2000.0;
  double bias_V = -450.0;
  double mobility_cm2_V_s = 1034.0;  ///< of electrons: 86 ns through 2 mm at 450 V
  bool mirror_x = false;             ///< the chip's image is mirrored: x_D = -(x + 1/2 - 128) 55 um
  double walk_keV_ns = 14.0;         ///< time walk walk_keV_ns / (E - walk_pole_keV): 8.6 ns at 5 keV, 0.3 ns at 50 keV
  double walk_pole_keV = 3.37;
  double noise_sigma_keV = 1.5;   ///< of a cluster's energy, independent of it
  double rel_sigma_662 = 0.0127;  ///< growing as sqrt(E): 3 % FWHM at 662 keV
  double lost_keV = 6.5;          ///< what a cluster leaves in pixels below the threshold: lost_keV + lost_rel E, on
  double lost_rel = 0.006;        ///< average; both 0 where the calibration puts the peaks of large clusters right

  bool operator==(const SensorConfig&) const = default;
};

/// Throws std::invalid_argument that names the value unless thickness, mobility and resolution are positive and
/// finite and the bias is negative (electrons drift to the pixels).
void check(const SensorConfig& sensor);

/// Time that electrons need from the cathode to the pixels, t_max = d^2 / (mobility |V|).
[[nodiscard]] double max_drift_ns(const SensorConfig& sensor);
[[nodiscard]] double drift_velocity_um_ns(const SensorConfig& sensor);

/// How much later a hit of this energy crosses the threshold than one of infinite energy. At and near the pole it
/// stays at its value 1 keV above the pole.
[[nodiscard]] inline double time_walk_ns(const SensorConfig& sensor, double energy_keV) {
  return sensor.walk_keV_ns / std::max(energy_keV - sensor.walk_pole_keV, 1.0);
}

/// What was left in a cluster that reads this energy, on average: freed of the charge below the threshold.
[[nodiscard]] double deposited_keV(const SensorConfig& sensor, double energy_keV);

/// Standard deviation of a cluster's energy.
[[nodiscard]] double energy_sigma_keV(const SensorConfig& sensor, double energy_keV);

/// A point at fractional pixel coordinates and `z_um` in the detector frame D, m.
[[nodiscard]] Eigen::Vector3d pixel_to_D(const SensorConfig& sensor, double x_px, double y_px, double z_um = 0.0);

}  // namespace comptonaut
