// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "flight/trajectory.h"

namespace comptonaut {

/// How long a MAV at rest takes from `start_W` through the points in this order, s.
[[nodiscard]] double flight_time_s(const Eigen::Vector3d& start_W, std::span<const Eigen::Vector3d> points_W,
                                   std::span<const std::size_t> order, const MotionLimits& limits);

/// Shares points out among MAVs so that the last one is done early: for each start the points to visit, in order. Each
/// point is visited once. Found by moving points, and by changing pairs of them, out of the longest flight for as long
/// as that helps; the same for the same input. No starts: no shares.
[[nodiscard]] std::vector<std::vector<std::size_t>> share_by_time(std::span<const Eigen::Vector3d> starts_W,
                                                                  std::span<const Eigen::Vector3d> points_W,
                                                                  const MotionLimits& limits);

}  // namespace comptonaut
