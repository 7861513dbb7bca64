// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/batch_key.h"
#include "core/time.h"
#include "detector/event_batch.h"

namespace comptonaut {

/// One hypothesis of one Compton pair in the world frame W: a source in direction u from the scatter point S has
/// angle(u, axis_W) = beta, up to the angular error.
struct Cone {
  std::int32_t offset_us = 0;                         ///< time of the photon after the batch's utime
  std::int32_t event = 0;                             ///< number within the batch; hypotheses of one photon share it
  std::int32_t channel = 0;                           ///< index into the batch's channels
  Eigen::Vector3d p_WS = Eigen::Vector3d::Zero();     ///< m
  Eigen::Vector3d axis_W = Eigen::Vector3d::UnitZ();  ///< unit vector to the source's side
  double cos_beta = 0.0;
  double weight = 0.0;  ///< probability of this hypothesis
};

/// What one detector measured in [utime, utime + duration_us), and from where: a viewpoint with its live time and
/// counts, and the cones of its pairs. More cones than fit a datagram go on in batches of the same utime that have no
/// live time and no counts.
struct MeasurementBatch {
  BatchKey key;
  Utime utime = 0;
  std::int32_t duration_us = kBatch_us;
  std::int32_t live_us = 0;  ///< 0 also where no pose was known: nothing was measured then
  std::int32_t utime_sigma_us = 0;
  Eigen::Vector3d p_WD = Eigen::Vector3d::Zero();            ///< detector at the middle of the batch, m
  Eigen::Quaterniond q_WD = Eigen::Quaterniond::Identity();  ///< rotates D to W, at the middle of the batch
  Eigen::Vector3d v_WD = Eigen::Vector3d::Zero();            ///< velocity in W at the middle of the batch, m/s;
                                                             ///< NaN: no pose was known, p_WD is an old one
  double battery_percent = std::numeric_limits<double>::quiet_NaN();  ///< as last told by the autopilot; NaN: unknown
  std::int32_t others = 0;
  std::vector<ChannelCounts> channels;
  std::vector<Cone> cones;

  [[nodiscard]] bool has_pose() const { return v_WD.allFinite(); }
  [[nodiscard]] Utime end_utime() const { return utime + duration_us; }
};

/// Cones that fit one datagram of the team bus beside the rest of a batch.
inline constexpr std::size_t kMaxConesPerBatch = 20;

}  // namespace comptonaut
