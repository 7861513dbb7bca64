// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/pose.h"
#include "mavlink/messages.h"
#include "nodes/status.h"
#include "nodes/vehicle_state.h"

namespace comptonaut {

/// Makes poses of ODOMETRY, and refuses what cannot be trusted.
class OdometryIntake {
 public:
  /// p_WN_m: origin of the autopilot's local frame.
  explicit OdometryIntake(const Eigen::Vector3d& p_WN_m) : p_WN_m_(p_WN_m) {}

  /// nullopt: refused, see complaint().
  [[nodiscard]] std::optional<StampedPose> pose_of(const Odometry& odometry);

  /// Of an odometry that was accepted. A variance that is not positive counts as unknown.
  [[nodiscard]] PoseQuality quality_of(const Odometry& odometry) const;

  /// Why the last odometry was refused, in words; empty: it was not.
  [[nodiscard]] const std::string& complaint() const { return complaint_; }
  [[nodiscard]] std::vector<Counter> counters() const;

 private:
  std::nullopt_t refuse(std::int64_t& counter, std::string complaint);
  [[nodiscard]] bool time_is_credible(Utime utime);

  Eigen::Vector3d p_WN_m_;
  Utime last_utime_ = 0;
  int backwards_in_a_row_ = 0;
  std::optional<std::uint8_t> reset_counter_;
  std::int32_t estimator_resets_ = 0;
  std::int64_t accepted_ = 0, not_finite_ = 0, other_frame_ = 0, failed_ = 0, not_unix_time_ = 0, backwards_ = 0;
  std::int64_t clock_resets_ = 0;
  std::string complaint_;
};

}  // namespace comptonaut
