// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <iterator>
#include <string>
#include <vector>

#include "nodes/mapper.h"
#include "start_time.h"

namespace comptonaut {

inline const BatchKey kFirst{.mission = 1, .sender = 2, .boot_epoch = 77, .number = 0};

inline MapperConfig config() { return {}; }

/// A MAV that flies east at 8 m/s, 2 m high, heading north-east, and passes the origin at kStart_us.
inline StampedPose pose_at(Utime utime) {
  const double t_s = seconds(utime - kStart_us);
  const Eigen::Quaterniond q_WB = from_yaw(0.785398163397448);
  return {
      .utime = utime, .p_WB = {8.0 * t_s, 0.0, 2.0}, .q_WB = q_WB, .v_WB_B = q_WB.inverse() * Eigen::Vector3d(8, 0, 0)};
}

inline PairEvent pair_at(std::int32_t offset_ns) {
  return {.offset_ns = offset_ns,
          .channel = 0,
          .e1_keV = 200,
          .e2_keV = 461,
          .a = {.axis_D = {0, 0, 1}, .cos_beta = 0.5, .probability = 0.25},
          .b = {.axis_D = {1, 0, 0}, .cos_beta = -0.5, .probability = 0.75}};
}

inline EventBatch events(std::int64_t number, std::vector<PairEvent> pairs = {}) {
  const auto n = static_cast<std::int32_t>(pairs.size());
  return {.key = {.mission = 1, .sender = 2, .boot_epoch = 5, .number = number},
          .utime = kStart_us + number * kBatch_us,
          .duration_us = kBatch_us,
          .live_us = 49'000,
          .utime_sigma_us = 3,
          .others = 4,
          .channels = {{"Cs-137", 10, n}},
          .pairs = std::move(pairs)};
}

inline std::int64_t counter(const Mapper& mapper, const std::string& name) {
  for (const Counter& c : mapper.counters()) {
    if (c.name == name) return c.value;
  }
  ADD_FAILURE() << "no counter " << name;
  return -1;
}

inline void append(std::vector<MeasurementBatch>& to, std::vector<MeasurementBatch> more) {
  std::move(more.begin(), more.end(), std::back_inserter(to));
}

/// Poses at 50 Hz from `from` to `to`.
inline std::vector<MeasurementBatch> fly(Mapper& mapper, Utime from, Utime to) {
  std::vector<MeasurementBatch> released;
  for (Utime utime = from; utime <= to; utime += 20'000) append(released, mapper.on_pose(pose_at(utime)));
  return released;
}

}  // namespace comptonaut
