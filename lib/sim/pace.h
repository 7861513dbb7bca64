// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/time.h"

namespace comptonaut {

struct PaceConfig {
  double lead_s = 0.5;          ///< simulated time may be so far ahead of the second that the coordinator works on
  double startup_s = 3.0;       ///< before its first tick, simulated time may go on for so long
  double time_scale_max = 0.0;  ///< simulated seconds per second at most; 0: as fast as the plans come
};

/// How far simulated time may go: at most to the coordinator's last tick + 1 s + lead, so that plans come as timely as
/// in real time however fast the daemons are.
class Pace {
 public:
  Pace(const PaceConfig& config, Utime start_utime, double horizon_s);

  /// The coordinator has finished this second. An older one changes nothing.
  void on_tick(Utime tick);
  /// Simulated time may go up to here, `wall_s` after the mission's start. Time lost by waiting for ticks is not made
  /// up for by going faster than time_scale_max later. To be asked at least a few times a second.
  [[nodiscard]] Utime limit(double wall_s);
  /// The coordinator has finished the horizon.
  [[nodiscard]] bool over() const { return tick_ >= end_; }

 private:
  PaceConfig config_;
  Utime start_;
  Utime end_;
  Utime tick_;
  Utime limit_;          ///< the last one
  double wall_s_ = 0.0;  ///< of the last one
};

}  // namespace comptonaut
