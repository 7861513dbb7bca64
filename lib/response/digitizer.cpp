// SPDX-License-Identifier: BSD-3-Clause
#include "response/digitizer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "response/electron_range.h"

namespace comptonaut {
namespace {

constexpr double kStep_um = 20.0;
constexpr double kBoltzmann_V_K = 8.617333e-5;  // k / e

void require_not_negative(const char* name, double value) {
  if (!(value >= 0.0) || !std::isfinite(value)) {
    throw std::invalid_argument(fmt::format("digitizer: {} = {}: must be finite and 0 or more", name, value));
  }
}

double normal_cdf(double x) { return 0.5 * std::erfc(-x * (1.0 / std::numbers::sqrt2)); }

/// How a blob at `at` (pixels) with this sigma is shared among pixels first, first + 1, ...; sums to 1.
struct Shares {
  static constexpr int kMost = 8;
  int first = 0;
  int count = 0;
  std::array<double, kMost> share;
};

Shares share_along(double at, double sigma) {
  const double reach = std::min(3.5 * sigma, 0.5 * (Shares::kMost - 2));
  Shares result{.first = static_cast<int>(std::floor(at - reach)), .count = 0, .share = {}};
  result.count = static_cast<int>(std::floor(at + reach)) - result.first + 1;
  double below = 0.0;
  for (int i = 0; i < result.count; ++i) {
    const bool last = i + 1 == result.count;
    const double up_to = last ? 1.0 : normal_cdf((result.first + i + 1 - at) / sigma);
    result.share[static_cast<std::size_t>(i)] = up_to - below;
    below = up_to;
  }
  return result;
}

}  // namespace

Block sensor_block(const SensorConfig& sensor) {
  const double half_m = 0.5e-6 * kChipPixels * kPixelPitch_um;
  return {.half_m = {half_m, half_m, 0.5e-6 * sensor.thickness_um}};
}

Digitizer::Digitizer(const DigitizerConfig& config, const SensorConfig& sensor, Calibration calibration)
    : config_(config),
      sensor_(sensor),
      calibration_(std::move(calibration)),
      half_um_(1e6 * sensor_block(sensor).half_m),
      velocity_um_ns_(drift_velocity_um_ns(sensor)),
      diffusion_um_(2.0 * kBoltzmann_V_K * config.temperature_K * sensor.thickness_um / std::abs(sensor.bias_V)),
      place_(Calibration::kPixels, 0) {
  check(sensor);
  require_not_negative("threshold_keV", config.threshold_keV);
  require_not_negative("noise_sigma_keV", config.noise_sigma_keV);
  require_not_negative("gain_rel_sigma", config.gain_rel_sigma);
  require_not_negative("jitter_sigma_ns", config.jitter_sigma_ns);
  require_not_negative("cloud_sigma_um", config.cloud_sigma_um);
  require_not_negative("temperature_K", config.temperature_K);
}

void Digitizer::digitize(std::span<const Deposit> deposits, double t_ns, Random& random, std::vector<Hit>& hits) {
  blobs_.clear();
  for (const Deposit& deposit : deposits) track(deposit, random);
  std::sort(blobs_.begin(), blobs_.end(), [](const Blob& a, const Blob& b) { return a.p_um.z() < b.p_um.z(); });
  for (const Blob& blob : blobs_) share(blob);
  read_out(t_ns, random, hits);
}

void Digitizer::track(const Deposit& deposit, Random& random) {
  Eigen::Vector3d p_um = 1e6 * deposit.p_D;
  Eigen::Vector3d direction = deposit.direction_D;
  double energy_keV = deposit.energy_keV;
  double left_um = electron_range_um(energy_keV);
  const bool moves = direction.squaredNorm() > 0.0;
  while (moves && left_um > kStep_um) {
    const double after_keV = energy_of_range_keV(left_um - kStep_um);
    const Eigen::Vector3d middle_um = p_um + 0.5 * kStep_um * direction;
    if ((middle_um.cwiseAbs().array() > half_um_.array()).any()) return;  // the rest of its energy left the block
    blobs_.push_back({.p_um = middle_um, .energy_keV = energy_keV - after_keV});
    p_um += kStep_um * direction;
    // Of an isotropic vector two thirds of the square lie across the direction, the two planes of the angle.
    const double turn_rad = multiple_scattering_rad(energy_keV, kStep_um);
    direction = (direction + std::sqrt(3.0) * turn_rad * random.unit_vector()).normalized();
    energy_keV = after_keV;
    left_um -= kStep_um;
  }
  if ((p_um.cwiseAbs().array() > half_um_.array()).any()) return;
  blobs_.push_back({.p_um = p_um, .energy_keV = energy_keV});
}

void Digitizer::share(const Blob& blob) {
  const double drift_um = blob.p_um.z() + half_um_.z();
  const double sigma_um = std::sqrt(diffusion_um_ * drift_um + config_.cloud_sigma_um * config_.cloud_sigma_um);
  const double sigma_px = std::max(sigma_um / kPixelPitch_um, 1e-6);
  const double x_um = sensor_.mirror_x ? -blob.p_um.x() : blob.p_um.x();
  const Shares along_x = share_along(x_um / kPixelPitch_um + 0.5 * kChipPixels, sigma_px);
  const Shares along_y = share_along(blob.p_um.y() / kPixelPitch_um + 0.5 * kChipPixels, sigma_px);
  for (int j = 0; j < along_y.count; ++j) {
    const double row_keV = blob.energy_keV * along_y.share[static_cast<std::size_t>(j)];
    for (int i = 0; i < along_x.count; ++i) {
      collect(along_x.first + i, along_y.first + j, row_keV * along_x.share[static_cast<std::size_t>(i)],
              drift_um / velocity_um_ns_);
    }
  }
}

void Digitizer::collect(int x, int y, double energy_keV, double arrival_ns) {
  if (x < 0 || x >= kChipPixels || y < 0 || y >= kChipPixels) return;  // beyond the outermost pixels: the guard ring
  const auto pixel = static_cast<std::uint16_t>(kChipPixels * y + x);
  std::uint16_t& place = place_[pixel];
  if (place == 0) {
    charges_.push_back({.pixel = pixel, .energy_keV = 0.0, .time_ns = 0.0});
    place = static_cast<std::uint16_t>(charges_.size());
  }
  Charge& charge = charges_[place - 1U];
  if (charge.energy_keV < config_.threshold_keV) charge.time_ns = arrival_ns;
  charge.energy_keV += energy_keV;
}

void Digitizer::read_out(double t_ns, Random& random, std::vector<Hit>& hits) {
  const auto first = static_cast<std::ptrdiff_t>(hits.size());
  for (const Charge& charge : charges_) {
    place_[charge.pixel] = 0;
    if (charge.energy_keV < 0.3 * config_.threshold_keV) continue;  // hopeless: spares the draws
    const double sigma_keV = std::hypot(config_.noise_sigma_keV, config_.gain_rel_sigma * charge.energy_keV);
    const double energy_keV = charge.energy_keV + sigma_keV * random.normal();
    if (energy_keV < config_.threshold_keV) continue;
    const std::uint16_t tot = calibration_.tot(charge.pixel, energy_keV);
    if (tot == 0) continue;
    const double time_ns =
        t_ns + charge.time_ns + time_walk_ns(sensor_, energy_keV) + config_.jitter_sigma_ns * random.normal();
    hits.push_back({.t = std::llround(time_ns / kChipTime_ns), .pixel = charge.pixel, .tot = tot});
  }
  charges_.clear();
  std::sort(hits.begin() + first, hits.end(),
            [](const Hit& a, const Hit& b) { return a.t != b.t ? a.t < b.t : a.pixel < b.pixel; });
}

}  // namespace comptonaut
