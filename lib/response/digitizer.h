// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/random.h"
#include "detector/calibration.h"
#include "detector/hit.h"
#include "detector/sensor.h"
#include "physics/block.h"
#include "physics/transport.h"

namespace comptonaut {

/// What the chip makes of charge. These make 3 % FWHM of a cluster of 630 keV, most of it charge below the threshold.
struct DigitizerConfig {
  double threshold_keV = 5.0;     ///< a pixel with less charge does not fire
  double noise_sigma_keV = 0.8;   ///< of a pixel's energy, whatever its energy: electronics
  double gain_rel_sigma = 0.015;  ///< of a pixel's energy: calibration, trapping
  double jitter_sigma_ns = 1.0;   ///< of a pixel's time
  double cloud_sigma_um = 8.0;    ///< of the charge cloud before it drifts: its start and its repulsion
  double temperature_K = 298.0;   ///< of the sensor: diffusion
};

/// The crystal over the chip: 256 x 256 pixels wide, as thick as the sensor.
[[nodiscard]] Block sensor_block(const SensorConfig& sensor);

/// Makes pixel hits of deposits, as a Timepix3 with electron collection does: the electron's track, the drift of its
/// charge to the pixels at the low-z face, diffusion and sharing among pixels, threshold, energy and time noise, time
/// walk, ToT by inverse calibration, ToA in steps of 25/16 ns. Masked pixels never fire.
///
/// - track: Kanaya and Okayama's range (1972) as path length, energy left by residual range; steps of at most 20 um
///   turned by Highland's multiple scattering angle: 400 keV go 0.39 mm and spread over some 0.2 mm
/// - diffusion: sigma^2 = 2 k T / e times drift length times thickness over bias
/// - time: that of the charge with which the pixel crosses the threshold, plus time walk
/// Keeps memory of its own for reuse, nothing of earlier calls.
class Digitizer {
 public:
  /// Throws std::invalid_argument that names a value that is negative or not finite.
  Digitizer(const DigitizerConfig& config, const SensorConfig& sensor, Calibration calibration);

  /// Appends the hits of one photon that came at t_ns on the chip's clock to `hits`, earlier first.
  void digitize(std::span<const Deposit> deposits, double t_ns, Random& random, std::vector<Hit>& hits);

 private:
  /// Charge that drifts as one.
  struct Blob {
    Eigen::Vector3d p_um;
    double energy_keV = 0.0;
  };
  /// What one pixel has collected.
  struct Charge {
    std::uint16_t pixel = 0;
    double energy_keV = 0.0;
    double time_ns = 0.0;  ///< of crossing the threshold; until then, of the latest blob
  };
  void track(const Deposit& deposit, Random& random);
  void share(const Blob& blob);
  void collect(int x, int y, double energy_keV, double arrival_ns);
  void read_out(double t_ns, Random& random, std::vector<Hit>& hits);

  DigitizerConfig config_;
  SensorConfig sensor_;
  Calibration calibration_;
  Eigen::Vector3d half_um_;
  double velocity_um_ns_;
  double diffusion_um_;  ///< sigma^2 per drift length
  std::vector<Blob> blobs_;
  std::vector<Charge> charges_;
  std::vector<std::uint16_t> place_;  ///< per pixel: place in charges_ plus one, or 0
};

}  // namespace comptonaut
