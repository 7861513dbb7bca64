// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "detector/hit.h"

namespace comptonaut {

/// What one row of hit data says, whatever the format.
struct StreamItem {
  enum class Kind : std::uint8_t {
    kHit,
    kHeader,     ///< a measurement begins
    kStart,      ///< UTC of chip time 0, in `value`
    kAlive,      ///< every hit up to `value` (chip time) has been sent, and the detector lived
    kShutter,    ///< times up to `value` (chip time) are of a frame that begins here, however far off
    kLostBegin,  ///< data were lost from `value` (chip time) on
    kLostEnd,    ///< and for `value` units of chip time
    kLostHit,    ///< a row that was left out may have been a hit
  };
  std::int64_t value = 0;   ///< chip time of a hit
  std::uint32_t line = 0;   ///< from 1; of binary data the number of the record
  std::uint32_t index = 0;  ///< of a hit: the row's Index; 0 where the format has none
  std::uint16_t pixel = 0;
  std::uint16_t tot = 0;
  float energy_keV = 0.0F;  ///< of a hit, where the format gives energies
  Kind kind = Kind::kHit;

  [[nodiscard]] Hit hit() const { return {.t = value, .pixel = pixel, .tot = tot, .energy_keV = energy_keV}; }
};

}  // namespace comptonaut
