// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "detector/cluster.h"
#include "detector/event_batch.h"
#include "detector/nuclide.h"
#include "detector/reading.h"
#include "detector/sensor.h"

namespace comptonaut {

/// Both readings of two clusters that one photon left.
struct PairHypotheses {
  ConeHypothesis a;  ///< scattered in the first cluster, absorbed in the second
  ConeHypothesis b;  ///< the other way
};

/// Depth of the first cluster over the second: z_1 - z_2 = v_drift (t_1 - t_2), um, along +z of D. Electrons drift to
/// the pixels on the low-z face, so the later cluster lay farther from them.
[[nodiscard]] double depth_difference_um(const SensorConfig& sensor, const Cluster& first, const Cluster& second);

/// Cones and probabilities of both hypotheses for a photon that the reader knows. Angle and probability come from the
/// two energies, freed of what clusters lose, and from the distance; which of the two clusters was read out first tells
/// nothing. nullopt unless the summed energy, as read, lies in the channel's window and at least one hypothesis is
/// physical. A hypothesis is not where its electron has more than two scatters of a photon of the line can leave in
/// one cluster, widened by pair_sigmas. (One scatter's limits, the Compton edge and the backscattered photon, would cut
/// the true hypothesis of one pair in fifteen: reading.h.)
[[nodiscard]] std::optional<PairHypotheses> pair_hypotheses(const SensorConfig& sensor, const NuclideChannel& channel,
                                                            const PairReader& reader, const Cluster& first,
                                                            const Cluster& second);

}  // namespace comptonaut
