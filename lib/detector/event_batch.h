// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "core/batch_key.h"
#include "core/time.h"

namespace comptonaut {

/// Where a photon may have come from, if it scattered in one cluster and was absorbed in the other.
struct ConeHypothesis {
  Eigen::Vector3d axis_D = Eigen::Vector3d::UnitZ();  ///< unit vector to the source's side, detector frame D
  double cos_beta = 0.0;                              ///< cosine of the cone's half-angle
  double probability = 0.0;                           ///< 0: not physical; A and B sum to 1
};

/// A Compton pair as it is sent on. Cluster 1 is the earlier one. A: 1 scattered, 2 absorbed; B the other way.
struct PairEvent {
  std::int32_t offset_ns = 0;  ///< time of cluster 1 after the batch's utime
  std::int32_t channel = 0;    ///< index into the batch's channels
  double e1_keV = 0.0;
  double e2_keV = 0.0;
  ConeHypothesis a;
  ConeHypothesis b;
};

/// Events of one energy channel (nuclide line window) within one batch.
struct ChannelCounts {
  std::string nuclide;
  std::int32_t singles = 0;
  std::int32_t pairs = 0;

  bool operator==(const ChannelCounts&) const = default;
};

/// All events of one detector in [utime, utime + duration_us), complete, also when nothing was hit.
struct EventBatch {
  BatchKey key;
  Utime utime = 0;
  std::int32_t duration_us = kBatch_us;
  std::int32_t live_us = 0;         ///< time in which the detector could see
  std::int32_t utime_sigma_us = 0;  ///< uncertainty of chip time against UTC
  std::int32_t others = 0;          ///< events that are neither a single nor a pair of a channel
  std::vector<ChannelCounts> channels;
  std::vector<PairEvent> pairs;
};

}  // namespace comptonaut
