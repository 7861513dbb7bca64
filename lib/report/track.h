// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "core/pose.h"
#include "report/mission_record.h"

namespace comptonaut {

/// A track holds a point each half metre, so that the noise of a hovering drone's pose is no distance flown.
inline constexpr double kTrackStep_m = 0.5;

/// Adds the point if it lies a step or more from the last one.
void extend_track(std::vector<TrackPoint>& track, const TrackPoint& point);

[[nodiscard]] double length_m(const std::vector<TrackPoint>& track);

/// Where the body of `pose` is at `utime` at constant velocity, frame W. nullopt: more than 0.2 s away.
[[nodiscard]] std::optional<Eigen::Vector3d> position_at(const StampedPose& pose, Utime utime);

}  // namespace comptonaut
