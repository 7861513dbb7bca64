// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <optional>

#include "core/pose.h"

namespace comptonaut {

/// The last poses of one MAV in order of time, whatever order they came in. One that is older than the newest by more
/// than may lie between two poses means that the clock was set back: those before it are forgotten.
class PoseBuffer {
 public:
  /// Interpolates between poses that lie at most `gap_max_us` apart.
  explicit PoseBuffer(Utime gap_max_us) : gap_max_us_(gap_max_us) {}

  /// False, and nothing kept, where there is a pose of the same time already.
  bool add(const StampedPose& pose);

  /// nullopt where no two poses that are near enough to each other enclose `utime`.
  [[nodiscard]] std::optional<StampedPose> at(Utime utime) const;
  /// The newest pose that is not later than `utime`, however old; before the first one that one; nullopt without any.
  [[nodiscard]] std::optional<StampedPose> last_known(Utime utime) const;

 private:
  static constexpr std::size_t kMaxPoses = 4096;  // 80 s at 50 Hz
  Utime gap_max_us_;
  std::map<Utime, StampedPose> poses_;
};

}  // namespace comptonaut
