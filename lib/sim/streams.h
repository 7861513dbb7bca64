// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "core/random.h"

namespace comptonaut {

/// What a stream of random numbers is for. Each purpose of each MAV has its own, so that no change in one part of the
/// simulation (more photons, another path, a trap) changes what another part draws.
enum class Purpose : std::uint64_t {
  kSources,
  kMount,
  kPoseNoise,
  kPhotons,
  kDigitizer,
  kBackground,
  kArrival,
  kTraps,
  kStray,
  kRange
};

/// mav 0: what all MAVs share.
[[nodiscard]] inline Random random_stream(std::uint64_t seed, Purpose purpose, int mav = 0) {
  return Random(seed, (static_cast<std::uint64_t>(purpose) << 32) | static_cast<std::uint32_t>(mav));
}

}  // namespace comptonaut
