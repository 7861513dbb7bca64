// SPDX-License-Identifier: BSD-3-Clause
#include "sim/pace.h"

#include <algorithm>
#include <cmath>

namespace comptonaut {
namespace {}  // namespace

Pace::Pace(const PaceConfig& config, Utime start_utime, double horizon_s)
    : config_(config),
      start_(start_utime),
      end_(start_utime + microseconds(horizon_s)),
      tick_(start_utime),
      limit_(start_utime) {}

void Pace::on_tick(Utime tick) { tick_ = std::max(tick_, tick); }

Utime Pace::limit(double wall_s) {
  const bool started = tick_ > start_;
  const Utime by_ticks =
      started ? tick_ + kSecond_us + microseconds(config_.lead_s) : start_ + microseconds(config_.startup_s);
  if (config_.time_scale_max <= 0.0) return by_ticks;
  const Utime by_clock = limit_ + microseconds(config_.time_scale_max * (wall_s - wall_s_));
  wall_s_ = wall_s;
  limit_ = std::max(limit_, std::min(by_ticks, by_clock));
  return limit_;
}

}  // namespace comptonaut
