// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/other_poses.h"

#include <cmath>

#include "nodes/mav_channel.h"

namespace comptonaut {
namespace {

constexpr Utime kForgotten_us = 1'000;  // of the least delay at each pose: of late is some 10 s ago

}  // namespace

void OtherPoses::on_pose(int mav, StampedPose pose, Utime own_utime) {
  if (mav == own_mav_) return;
  if (mav < 1 || mav > kMaxMav) {
    ++refused_;
    return;
  }
  if (own_utime > 0) {
    const Utime age_us = own_utime - pose.utime;
    Utime& behind_us = behind_us_.try_emplace(mav, age_us).first->second;
    const bool set_back = age_us > behind_us + age_max_us_;
    behind_us = set_back ? age_us : std::min(age_us, behind_us + kForgotten_us);
    const bool wrong = std::abs(seconds(behind_us)) > kClockTolerance_s;
    if (wrong) pose.utime += behind_us;
    if (wrong) ++corrected_;
  }
  others_[mav] = pose;
}

std::vector<Counter> OtherPoses::counters() const {
  return {{"others_refused", refused_}, {"others_clock_corrected", corrected_}};
}

}  // namespace comptonaut
