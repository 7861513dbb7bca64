// SPDX-License-Identifier: BSD-3-Clause
#include "report/track.h"

#include <cmath>

namespace comptonaut {

void extend_track(std::vector<TrackPoint>& track, const TrackPoint& point) {
  const bool moved = track.empty() || (point.p_W - track.back().p_W).norm() >= kTrackStep_m;
  if (moved) track.push_back(point);
}

double length_m(const std::vector<TrackPoint>& track) {
  double sum_m = 0.0;
  for (std::size_t i = 1; i < track.size(); ++i) sum_m += (track[i].p_W - track[i - 1].p_W).norm();
  return sum_m;
}

std::optional<Eigen::Vector3d> position_at(const StampedPose& pose, Utime utime) {
  const double dt_s = seconds(utime - pose.utime);
  if (std::abs(dt_s) > 0.2) return std::nullopt;
  return pose.p_WB + dt_s * (pose.q_WB * pose.v_WB_B);
}

}  // namespace comptonaut
