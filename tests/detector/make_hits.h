// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "detector/calibration.h"
#include "detector/hit.h"
#include "detector/sensor.h"

namespace comptonaut {

inline std::uint16_t pixel_at(int x, int y) { return static_cast<std::uint16_t>(kChipPixels * y + x); }

inline ChipTime chip_time_ns(double ns) { return std::llround(ns / kChipTime_ns); }

/// The same for each pixel.
inline const Calibration& typical_calibration() {
  static const Calibration calibration = Calibration::uniform();
  return calibration;
}

/// What one pixel reads of a deposit whose charge arrives at t_ns.
inline Hit make_hit(int x, int y, double energy_keV, double t_ns, const SensorConfig& sensor = SensorConfig{},
                    const Calibration& calibration = typical_calibration()) {
  return {.t = chip_time_ns(t_ns + time_walk_ns(sensor, energy_keV)),
          .pixel = pixel_at(x, y),
          .tot = calibration.tot(pixel_at(x, y), energy_keV)};
}

inline std::string t3pa_row(std::int64_t index, const Hit& hit) {
  const std::int64_t toa = (hit.t + 15) / 16;
  const std::int64_t ftoa = 16 * toa - hit.t;
  return std::to_string(index) + "\t" + std::to_string(hit.pixel) + "\t" + std::to_string(toa) + "\t" +
         std::to_string(hit.tot) + "\t" + std::to_string(ftoa) + "\t0\n";
}

inline const std::string kT3paHeader = "Index\tMatrix Index\tToA\tToT\tFToA\tOverflow\n";

inline std::string t3pa_text(const std::vector<Hit>& hits) {
  std::string text = kT3paHeader;
  for (std::size_t i = 0; i < hits.size(); ++i) text += t3pa_row(static_cast<std::int64_t>(i), hits[i]);
  return text;
}

}  // namespace comptonaut
