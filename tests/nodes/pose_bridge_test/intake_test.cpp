// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "nodes/odometry_intake.h"
#include "start_time.h"

namespace comptonaut {
namespace {

Odometry odometry(std::uint64_t time_usec = kStart_us) {
  Odometry m;
  m.time_usec = time_usec;
  m.position_m = {1, 2, -3};  // 1 m north, 2 m east, 3 m up
  m.velocity_m_s = {4, 5, 6};
  m.rates_rad_s = {0.1F, 0.2F, 0.3F};
  return m;
}

std::int64_t count(const OdometryIntake& intake, const std::string& name) {
  for (const Counter& counter : intake.counters()) {
    if (counter.name == name) return counter.value;
  }
  ADD_FAILURE() << "no counter " << name;
  return -1;
}

TEST(OdometryIntake, GivesThePoseInOurFrames) {
  OdometryIntake intake({100, 200, 10});
  const auto pose = intake.pose_of(odometry());  // nose to the north, level
  ASSERT_TRUE(pose);
  EXPECT_EQ(pose->utime, kStart_us);
  EXPECT_TRUE(pose->p_WB.isApprox(Eigen::Vector3d(102, 201, 13)));
  EXPECT_NEAR(yaw_of(pose->q_WB), M_PI / 2, 1e-6);
  EXPECT_TRUE(pose->v_WB_B.isApprox(Eigen::Vector3d(4, -5, -6)));
  EXPECT_TRUE(pose->w_WB_B.isApprox(Eigen::Vector3d(0.1, -0.2, -0.3), 1e-6));
  EXPECT_TRUE((pose->q_WB * pose->v_WB_B).isApprox(Eigen::Vector3d(5, 4, -6), 1e-6));
}

TEST(OdometryIntake, RefusesWhatCannotBeTrustedAndSaysWhy) {
  const std::vector<std::pair<std::string, std::function<void(Odometry&)>>> faults{
      {"odometry_not_finite", [](Odometry& m) { m.position_m[1] = NAN; }},
      {"odometry_not_finite", [](Odometry& m) { m.velocity_m_s[0] = INFINITY; }},
      {"odometry_not_finite", [](Odometry& m) { m.rates_rad_s[2] = NAN; }},
      {"odometry_not_finite", [](Odometry& m) { m.q[0] = NAN; }},
      {"odometry_not_finite",
       [](Odometry& m) {
         m.q = {0.5, 0.5, 0.5, 0.6F};
       }},
      {"odometry_not_finite", [](Odometry& m) { m.position_m[0] = 1e9F; }},
      {"odometry_other_frame", [](Odometry& m) { m.frame_id = 0; }},
      {"odometry_other_frame", [](Odometry& m) { m.child_frame_id = 8; }},
      {"odometry_failed", [](Odometry& m) { m.quality = -1; }},
      {"odometry_not_unix_time", [](Odometry& m) { m.time_usec = 35'000'000; }},
      {"odometry_not_unix_time", [](Odometry& m) { m.time_usec = ~std::uint64_t{0}; }},
      {"odometry_backwards", [](Odometry& m) { m.time_usec = kStart_us; }},
      {"odometry_backwards", [](Odometry& m) { m.time_usec = kStart_us - 1; }},
  };
  for (std::size_t i = 0; i < faults.size(); ++i) {
    OdometryIntake intake({0, 0, 0});
    ASSERT_TRUE(intake.pose_of(odometry()));
    Odometry bad = odometry(kStart_us + 20'000);
    faults[i].second(bad);
    EXPECT_FALSE(intake.pose_of(bad)) << i << ": " << faults[i].first;
    EXPECT_EQ(count(intake, faults[i].first), 1) << i << ": " << faults[i].first;
    EXPECT_NE(intake.complaint(), "") << i << ": " << faults[i].first;
    EXPECT_TRUE(intake.pose_of(odometry(kStart_us + 40'000))) << i;
    EXPECT_EQ(intake.complaint(), "") << i;
  }
}

TEST(OdometryIntake, TakesAClockThatStaysBackAsSetAnew) {
  OdometryIntake intake({0, 0, 0});
  ASSERT_TRUE(intake.pose_of(odometry(kStart_us + 3'600'000'000)));
  std::uint64_t time_usec = kStart_us;
  int refused = 0;
  while (!intake.pose_of(odometry(time_usec += 20'000))) ASSERT_LT(++refused, 100);
  EXPECT_EQ(refused, 20);
  EXPECT_EQ(count(intake, "odometry_clock_resets"), 1);
  EXPECT_TRUE(intake.pose_of(odometry(time_usec + 20'000)));
}

TEST(OdometryIntake, ReadsQualityFromCovarianceAndResets) {
  OdometryIntake intake({0, 0, 0});
  Odometry m = odometry();
  m.pose_covariance[0] = 0.04F;   // x x
  m.pose_covariance[6] = 0.09F;   // y y
  m.pose_covariance[11] = 0.25F;  // z z
  m.pose_covariance[20] = 0.01F;  // yaw yaw
  m.quality = 80;
  ASSERT_TRUE(intake.pose_of(m));
  const PoseQuality quality = intake.quality_of(m);
  EXPECT_NEAR(quality.position_sigma_m, 0.3, 1e-6);
  EXPECT_NEAR(quality.height_sigma_m, 0.5, 1e-6);
  EXPECT_NEAR(quality.yaw_sigma_rad, 0.1, 1e-6);
  EXPECT_EQ(quality.quality_percent, 80);
  EXPECT_EQ(quality.resets, 0);

  m = odometry(kStart_us + 20'000);
  m.pose_covariance[0] = NAN;
  m.reset_counter = 1;
  ASSERT_TRUE(intake.pose_of(m));
  EXPECT_TRUE(std::isnan(intake.quality_of(m).height_sigma_m));
  EXPECT_EQ(intake.quality_of(m).quality_percent, -1);
  EXPECT_EQ(intake.quality_of(m).resets, 1);
}

}  // namespace
}  // namespace comptonaut
