// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <vector>

#include "nodes/separation.h"
#include "nodes/status.h"

namespace comptonaut {

/// Where the other MAVs were last seen, in the time of this one's poses, so that a wrong clock hides nobody.
///
/// What a pose is older by when it comes is its way and what its MAV's clock is behind; the least of late is taken for
/// the clock. A pose that is older still by pose_age_max_s shows that the clock was set back. Clocks that are no
/// further off than kClockTolerance_s count as right.
class OtherPoses {
 public:
  static constexpr double kClockTolerance_s = 0.25;

  OtherPoses(int own_mav, double pose_age_max_s) : own_mav_(own_mav), age_max_us_(microseconds(pose_age_max_s)) {}

  /// `own_utime`: of the last own pose, 0 before the first. Numbers other than 1..kMaxMav are counted and left out.
  void on_pose(int mav, StampedPose pose, Utime own_utime);

  [[nodiscard]] const Others& others() const { return others_; }
  [[nodiscard]] std::vector<Counter> counters() const;

 private:
  int own_mav_;
  Utime age_max_us_;
  Others others_;
  std::map<int, Utime> behind_us_;  ///< each MAV's clock
  std::int64_t refused_ = 0, corrected_ = 0;
};

}  // namespace comptonaut
