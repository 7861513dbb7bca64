// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/pose.h"
#include "core/random.h"
#include "nodes/range_points.h"
#include "world/world.h"

namespace comptonaut {

struct RangeSensorConfig {
  double range_m = 20.0;
  int rays = 400;  ///< of each scan: all round, 45 degrees up and down
  double period_s = 0.2;
};

/// A range sensor at the MAV's origin that sees what is occupied. Its rays go elsewhere in each scan.
class RangeSensor {
 public:
  RangeSensor(const RangeSensorConfig& config, Random random) : config_(config), random_(random) {}

  [[nodiscard]] bool is_due(Utime since_start_us) const { return since_start_us % microseconds(config_.period_s) == 0; }
  /// Points, with an error of 2 cm along the ray; rays that end nowhere within range have none.
  [[nodiscard]] RangePoints scan(const World& world, const StampedPose& pose);

 private:
  RangeSensorConfig config_;
  Random random_;
};

}  // namespace comptonaut
