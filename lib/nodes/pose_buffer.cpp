// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/pose_buffer.h"

namespace comptonaut {

bool PoseBuffer::add(const StampedPose& pose) {
  const bool clock_set_back = !poses_.empty() && pose.utime < poses_.rbegin()->first - gap_max_us_;
  if (clock_set_back) poses_.clear();
  if (!poses_.emplace(pose.utime, pose).second) return false;
  if (poses_.size() > kMaxPoses) poses_.erase(poses_.begin());
  return true;
}

std::optional<StampedPose> PoseBuffer::at(Utime utime) const {
  const auto after = poses_.lower_bound(utime);
  if (after == poses_.end()) return {};
  if (after->first == utime) return after->second;
  if (after == poses_.begin()) return {};
  const auto before = std::prev(after);
  if (after->first - before->first > gap_max_us_) return {};
  return interpolate(before->second, after->second, utime);
}

std::optional<StampedPose> PoseBuffer::last_known(Utime utime) const {
  if (poses_.empty()) return {};
  const auto after = poses_.upper_bound(utime);
  return after == poses_.begin() ? after->second : std::prev(after)->second;
}

}  // namespace comptonaut
