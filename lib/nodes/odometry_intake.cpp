// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/odometry_intake.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "nodes/frames.h"

namespace comptonaut {
namespace {

// 2001 to 2100: an autopilot that does not know the date counts from its start.
constexpr std::uint64_t kUnixMin_us = 1'000'000'000'000'000;
constexpr std::uint64_t kUnixMax_us = 4'102'444'800'000'000;
constexpr int kBackwardsMax = 20;
constexpr double kUnitTolerance = 1e-3;
constexpr double kFar_m = 1e6;

Eigen::Vector3d vector(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }

Eigen::Quaterniond quaternion(const Odometry& m) { return {m.q[0], m.q[1], m.q[2], m.q[3]}; }

bool is_sound(const Odometry& m) {
  const auto finite = [](const auto& values) {
    return std::ranges::all_of(values, [](float x) { return std::isfinite(x); });
  };
  return finite(m.position_m) && finite(m.q) && finite(m.velocity_m_s) && finite(m.rates_rad_s) &&
         vector(m.position_m).norm() < kFar_m && std::abs(quaternion(m).norm() - 1.0) < kUnitTolerance;
}

// Indices into the upper right triangle of a 6 x 6 matrix, row by row.
constexpr std::size_t kXX = 0, kYY = 6, kZZ = 11, kYawYaw = 20;

double sigma(double variance) {
  return variance > 0.0 && std::isfinite(variance) ? std::sqrt(variance) : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

std::nullopt_t OdometryIntake::refuse(std::int64_t& counter, std::string complaint) {
  ++counter;
  complaint_ = std::move(complaint);
  return std::nullopt;
}

std::optional<StampedPose> OdometryIntake::pose_of(const Odometry& m) {
  if (m.frame_id != kFrameLocalNed || m.child_frame_id != kFrameBodyFrd) {
    return refuse(other_frame_, fmt::format("odometry is in frames {} and {}, must be LOCAL_NED (1) and BODY_FRD (12)",
                                            m.frame_id, m.child_frame_id));
  }
  if (m.quality < 0) return refuse(failed_, "the autopilot says that its odometry has failed");
  if (!is_sound(m)) return refuse(not_finite_, "odometry is not finite or its quaternion is not unit");
  if (m.time_usec < kUnixMin_us || m.time_usec > kUnixMax_us) {
    return refuse(not_unix_time_, fmt::format("odometry time {} us is not Unix time", m.time_usec));
  }
  const auto utime = static_cast<Utime>(m.time_usec);
  if (!time_is_credible(utime)) return refuse(backwards_, "odometry goes backwards in time");
  if (reset_counter_ && *reset_counter_ != m.reset_counter) ++estimator_resets_;
  reset_counter_ = m.reset_counter;
  last_utime_ = utime;
  complaint_.clear();
  ++accepted_;
  return StampedPose{.utime = utime,
                     .p_WB = p_WN_m_ + swap_W_N(vector(m.position_m)),
                     .q_WB = q_WB_from_NF(quaternion(m).normalized()),
                     .v_WB_B = swap_B_F(vector(m.velocity_m_s)),
                     .w_WB_B = swap_B_F(vector(m.rates_rad_s)),
                     .a_WB_B = Eigen::Vector3d::Zero()};
}

bool OdometryIntake::time_is_credible(Utime utime) {
  if (utime > last_utime_) {
    backwards_in_a_row_ = 0;
    return true;
  }
  if (++backwards_in_a_row_ <= kBackwardsMax) return false;
  backwards_in_a_row_ = 0;
  ++clock_resets_;
  return true;
}

PoseQuality OdometryIntake::quality_of(const Odometry& m) const {
  const auto& covariance = m.pose_covariance;
  return {.utime = static_cast<Utime>(m.time_usec),
          .position_sigma_m = sigma(std::max(covariance[kXX], covariance[kYY])),
          .height_sigma_m = sigma(covariance[kZZ]),
          .yaw_sigma_rad = sigma(covariance[kYawYaw]),
          .quality_percent = m.quality > 0 ? std::min<std::int32_t>(m.quality, 100) : -1,
          .resets = estimator_resets_};
}

std::vector<Counter> OdometryIntake::counters() const {
  return {{"odometry_accepted", accepted_},           {"odometry_not_finite", not_finite_},
          {"odometry_other_frame", other_frame_},     {"odometry_failed", failed_},
          {"odometry_not_unix_time", not_unix_time_}, {"odometry_backwards", backwards_},
          {"odometry_clock_resets", clock_resets_}};
}

}  // namespace comptonaut
