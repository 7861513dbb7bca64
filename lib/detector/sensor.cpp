// SPDX-License-Identifier: BSD-3-Clause
#include "detector/sensor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "detector/hit.h"

namespace comptonaut {
namespace {

void require(bool right, const std::string& name, double value, const std::string& what) {
  if (!right) throw std::invalid_argument(fmt::format("sensor: {} = {}: must be {}", name, value, what));
}

bool positive(double value) { return value > 0.0 && std::isfinite(value); }
bool not_negative(double value) { return value >= 0.0 && std::isfinite(value); }

constexpr double kReference_keV = 661.657;

}  // namespace

void check(const SensorConfig& sensor) {
  require(positive(sensor.thickness_um), "thickness_um", sensor.thickness_um, "positive");
  require(positive(-sensor.bias_V), "bias_V", sensor.bias_V, "negative");
  require(positive(sensor.mobility_cm2_V_s), "mobility_cm2_V_s", sensor.mobility_cm2_V_s, "positive");
  require(not_negative(sensor.walk_keV_ns), "walk_keV_ns", sensor.walk_keV_ns, "0 or more");
  require(std::isfinite(sensor.walk_pole_keV), "walk_pole_keV", sensor.walk_pole_keV, "finite");
  require(not_negative(sensor.noise_sigma_keV), "noise_sigma_keV", sensor.noise_sigma_keV, "0 or more");
  require(not_negative(sensor.lost_keV), "lost_keV", sensor.lost_keV, "0 or more");
  require(not_negative(sensor.lost_rel), "lost_rel", sensor.lost_rel, "0 or more");
  require(positive(sensor.rel_sigma_662), "rel_sigma_662", sensor.rel_sigma_662, "positive");
}

double max_drift_ns(const SensorConfig& sensor) { return sensor.thickness_um / drift_velocity_um_ns(sensor); }

double drift_velocity_um_ns(const SensorConfig& sensor) {
  const double field_V_um = std::abs(sensor.bias_V) / sensor.thickness_um;
  const double mobility_um2_V_ns = 0.1 * sensor.mobility_cm2_V_s;  // 1 cm^2/s = 1e8 um^2 / 1e9 ns
  return mobility_um2_V_ns * field_V_um;
}

double deposited_keV(const SensorConfig& sensor, double energy_keV) {
  return energy_keV * (1.0 + sensor.lost_rel) + sensor.lost_keV;
}

double energy_sigma_keV(const SensorConfig& sensor, double energy_keV) {
  const double statistical = sensor.rel_sigma_662 * sensor.rel_sigma_662 * kReference_keV * std::max(energy_keV, 0.0);
  return std::sqrt(sensor.noise_sigma_keV * sensor.noise_sigma_keV + statistical);
}

Eigen::Vector3d pixel_to_D(const SensorConfig& sensor, double x_px, double y_px, double z_um) {
  const double x_m = pixel_to_D_m(x_px);
  return {sensor.mirror_x ? -x_m : x_m, pixel_to_D_m(y_px), 1e-6 * z_um};
}

}  // namespace comptonaut
