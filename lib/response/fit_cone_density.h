// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "response/angular_error.h"
#include "response/cone_density.h"

namespace comptonaut {

/// Where the source of one simulated pair lay about one of its hypotheses.
struct ConeSample {
  ConeView cone;
  double weight = 1.0;
  Readings readings = Readings::kBoth;
};

/// The samples of one pair, weights of the pair's sum: the sole reading; of two the true one, or, where the photon did
/// not scatter first and there is none, both by their probabilities.
[[nodiscard]] std::vector<ConeSample> cone_samples(const SimulatedPair& pair);

/// Shares of the parts by maximum likelihood, node by node (EM on a mixture of known parts: the problem is concave, so
/// the start does not matter), with half a pair more for each part, so that no direction is impossible. Samples
/// between two nodes count for both, by nearness. A node with less than 200 pairs is left out: the density keeps the
/// shares of the outermost node beyond it. Throws std::invalid_argument if no node has 200 pairs for either kind of
/// readings.
[[nodiscard]] ConeDensity fit_cone_density(std::span<const SimulatedPair> pairs, ConeDensity::Facts facts = {});

}  // namespace comptonaut
