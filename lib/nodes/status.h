// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/time.h"

namespace comptonaut {

/// One number of a daemon's health; its unit is in the name where it has one ("rows_refused", "live_ms").
struct Counter {
  std::string name;
  std::int64_t value = 0;

  bool operator==(const Counter&) const = default;
};

/// A daemon's sign of life, published once a second.
struct DaemonStatus {
  Utime utime = 0;          ///< data time; 0 before the first input
  std::int32_t sender = 0;  ///< MAV number, 0 for the ground station
  std::string daemon;
  std::string version;
  std::string state;  ///< in words
  std::vector<Counter> counters;
};

}  // namespace comptonaut
