// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/time.h"

namespace comptonaut {

/// One scan of a MAV's range sensor: where its rays ended. A ray that met nothing has no point.
struct RangePoints {
  Utime utime = 0;
  Eigen::Vector3d p_BR = Eigen::Vector3d::Zero();  ///< the range sensor on the MAV, m
  double range_max_m = 0.0;                        ///< beyond it the sensor sees nothing
  std::vector<Eigen::Vector3f> points_B;           ///< frame B, m; NaN where the sensor does not know
};

/// More is no scan, but a fault.
inline constexpr std::size_t kMaxRangePoints = 50'000;

}  // namespace comptonaut
