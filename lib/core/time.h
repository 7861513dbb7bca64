// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>

namespace comptonaut {

/// Microseconds since the Unix epoch (UTC) of the moment that something happened.
using Utime = std::int64_t;

inline constexpr Utime kSecond_us = 1'000'000;

/// Events and measurements come in batches of this length, aligned to UTC.
inline constexpr Utime kBatch_us = 50'000;

/// The largest multiple of `period_us` that is not later than `utime`, also before 1970.
[[nodiscard]] constexpr Utime floor_to(Utime utime, Utime period_us) {
  const Utime remainder = utime % period_us;
  return utime - (remainder < 0 ? remainder + period_us : remainder);
}

[[nodiscard]] constexpr double seconds(Utime duration_us) { return 1e-6 * static_cast<double>(duration_us); }
[[nodiscard]] inline Utime microseconds(double duration_s) { return std::llround(1e6 * duration_s); }

}  // namespace comptonaut
