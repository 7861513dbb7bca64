// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/other_poses.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "perfect_vehicle.h"

namespace comptonaut {
namespace {

constexpr double kAgeMax_s = 2.0;

/// Poses of MAV 2 ten times a second, each 5 to 150 ms on its way; its clock is off by `off_s(i)` at pose i. The
/// greatest error of their age as MAV 1 sees them, s.
template <class Off>
double worst_age_error_s(OtherPoses& poses, int n, const Off& off_s) {
  Random random(3);
  double worst_s = 0.0;
  for (int i = 0; i < n; ++i) {
    const Utime measured = kStart_us + Utime{i} * 100'000;  // an int would overflow
    const Utime now = measured + static_cast<Utime>(random.uniform(5e3, 150e3));
    poses.on_pose(2, {.utime = measured + microseconds(off_s(i))}, now);
    worst_s = std::max(worst_s, std::abs(seconds(poses.others().at(2).utime - measured)));
  }
  return worst_s;
}

TEST(OtherPoses, LeavesTheTimesOfRightClocksAlone) {
  OtherPoses poses(1, kAgeMax_s);
  EXPECT_EQ(worst_age_error_s(poses, 1000, [](int) { return 0.0; }), 0.0);
  EXPECT_EQ(count(poses.counters(), "others_clock_corrected"), 0);
}

TEST(OtherPoses, CorrectsWrongClocksUpToTheLeastDelay) {
  for (const double off_s : {-1e6, -300.0, -1.0, 0.5, 300.0, 1e6}) {
    OtherPoses poses(1, kAgeMax_s);
    EXPECT_LT(worst_age_error_s(poses, 1000, [off_s](int) { return off_s; }), 0.15) << off_s;
    EXPECT_EQ(count(poses.counters(), "others_clock_corrected"), 1000) << off_s;
  }
}

TEST(OtherPoses, FollowsAClockThatIsSetWhileFlying) {
  for (const double step_s : {-300.0, -3.0, 1.0, 300.0}) {
    OtherPoses poses(1, kAgeMax_s);
    EXPECT_LT(worst_age_error_s(poses, 1000, [step_s](int i) { return i < 500 ? 0.0 : step_s; }), 0.31) << step_s;
  }
}

TEST(OtherPoses, FollowsAClockThatDrifts) {
  for (const double drift : {-5e-4, 5e-4}) {
    OtherPoses poses(1, kAgeMax_s);
    EXPECT_LT(worst_age_error_s(poses, 36'000, [drift](int i) { return 0.1 * drift * i; }), 0.31) << drift;
  }
}

TEST(OtherPoses, TakesALateOneForOldAgainOnceTheWayIsShort) {
  OtherPoses poses(1, kAgeMax_s);
  poses.on_pose(2, {.utime = kStart_us}, kStart_us + 20'000);
  poses.on_pose(2, {.utime = kStart_us + 100'000}, kStart_us + 5 * kSecond_us);  // as if the clock had been set back
  poses.on_pose(2, {.utime = kStart_us + 5 * kSecond_us}, kStart_us + 5 * kSecond_us + 20'000);
  EXPECT_EQ(poses.others().at(2).utime, kStart_us + 5 * kSecond_us);
}

TEST(OtherPoses, LeavesOutMavsThatCannotBe) {
  OtherPoses poses(7, kAgeMax_s);
  for (const int mav : {-1, 0, 251, 1 << 30}) poses.on_pose(mav, {.utime = kStart_us}, kStart_us);
  EXPECT_EQ(count(poses.counters(), "others_refused"), 4);
  for (const int mav : {1, 7, 250}) poses.on_pose(mav, {.utime = kStart_us}, kStart_us);
  EXPECT_EQ(poses.others().size(), 2u) << "and itself";
  EXPECT_EQ(count(poses.counters(), "others_refused"), 4);
}

}  // namespace
}  // namespace comptonaut
