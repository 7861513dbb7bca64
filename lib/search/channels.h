// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "search/coarse_ground.h"
#include "search/strategy.h"

namespace comptonaut {

/// Singles per Bq and second, seen at set height above one square (column) from another one (row): for each channel of
/// its own photons, then of those of the nuclides above it, as ChannelFacts::lines.
using Kernels = std::vector<std::vector<Eigen::ArrayXXf>>;
[[nodiscard]] Kernels singles_kernels(const CoarseGround& ground, const SearchState& state, double set_height_m);

/// The channel of a source's own nuclide; of one that has none, the first.
[[nodiscard]] std::size_t channel_of(const SearchFacts& facts, const SourceEstimate& source);

/// What the known sources give in a channel, seen from one place.
struct SourceRates {
  std::vector<double> of_source_per_s;  ///< as state.sources; 0 of the nuclides below
  double all_per_s = 0.0;               ///< with this much of background
};
[[nodiscard]] SourceRates source_rates(const CoarseGround& ground, const SearchState& state, std::size_t channel,
                                       const Eigen::Vector3d& from_W, double background_per_s);

/// Squared distance to a place somewhere in a square: its mean over both squares is a bit more.
[[nodiscard]] double softened_m2(const CoarseGround& ground, const Eigen::Vector3d& eye_W, const Eigen::Vector3d& p_W);

/// Singles of background per second and MAV in a channel: in the first as configured, in the others as the estimator
/// has found it; where it does not tell, as configured.
[[nodiscard]] double background_per_s(const SearchState& state, std::size_t channel, double configured_per_s);

/// What one channel tells of a nuclide's sources.
struct Evidence {
  std::size_t channel = 0;
  const Eigen::ArrayXXf& kernel;  ///< of the nuclide's photons in it
  Eigen::ArrayXf speaks;          ///< per square: 1, or 0 where the channel has a source of its own nuclide close by,
                                  ///< which may be one of the other, taken for its own
};

/// What is told of the nuclide of channel `nuclide`: in its own channel, then in those below. `kernels` must outlive
/// it.
[[nodiscard]] std::vector<Evidence> evidence_of(const CoarseGround& ground, const Kernels& kernels,
                                                const SearchState& state, std::size_t nuclide);

}  // namespace comptonaut
