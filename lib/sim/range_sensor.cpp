// SPDX-License-Identifier: BSD-3-Clause
#include "sim/range_sensor.h"

#include <cmath>
#include <numbers>

namespace comptonaut {

RangePoints RangeSensor::scan(const World& world, const StampedPose& pose) {
  constexpr double kError_m = 0.02;
  constexpr double kSinMax = std::numbers::sqrt2 / 2.0;
  RangePoints points{
      .utime = pose.utime, .p_BR = Eigen::Vector3d::Zero(), .range_max_m = config_.range_m, .points_B = {}};
  for (int i = 0; i < config_.rays; ++i) {
    const double azimuth_rad = random_.uniform(0.0, 2.0 * std::numbers::pi), z = random_.uniform(-kSinMax, kSinMax);
    const double across = std::sqrt(1.0 - z * z), error_m = kError_m * random_.normal();
    const Eigen::Vector3d ray_B(across * std::cos(azimuth_rad), across * std::sin(azimuth_rad), z);
    const auto range_m = world.range_m(pose.p_WB, pose.q_WB * ray_B, config_.range_m);
    if (!range_m) continue;
    const double told_m = std::min(config_.range_m, std::max(0.0, *range_m + error_m));
    points.points_B.emplace_back((told_m * ray_B).cast<float>());
  }
  return points;
}

}  // namespace comptonaut
