// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace comptonaut {

/// Timepix3 counts ToA in ticks of 25 ns and FToA back from it in sixteenths: t = 25 ns ToA - 25/16 ns FToA. Hit times
/// are whole numbers of that sixteenth, so that no rounding ever reorders two hits.
using ChipTime = std::int64_t;

inline constexpr double kChipTime_ns = 25.0 / 16.0;
inline constexpr int kChipPixels = 256;  ///< along each edge
inline constexpr double kPixelPitch_um = 55.0;

/// One pixel that fired.
struct Hit {
  ChipTime t = 0;           ///< 16 ToA - FToA, units of 25/16 ns
  std::uint16_t pixel = 0;  ///< matrix index, 256 y + x
  std::uint16_t tot = 0;    ///< time over threshold, ticks of 25 ns
  float energy_keV = 0.0F;  ///< where the source of the hit gave it; 0: tot and the calibration tell

  bool operator==(const Hit&) const = default;
};

[[nodiscard]] constexpr int pixel_x(std::uint16_t pixel) { return pixel % kChipPixels; }
[[nodiscard]] constexpr int pixel_y(std::uint16_t pixel) { return pixel / kChipPixels; }

/// Centre of a (fractional) pixel coordinate along one edge in the detector frame D, m:
/// x_D = (x + 1/2 - 128) 55 um.
[[nodiscard]] constexpr double pixel_to_D_m(double pixel_coordinate) {
  return (pixel_coordinate + 0.5 - kChipPixels / 2) * 1e-6 * kPixelPitch_um;
}

}  // namespace comptonaut
