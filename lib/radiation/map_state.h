// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "radiation/joint_model.h"

namespace comptonaut {

/// What a map estimates.
struct MapState {
  std::vector<double> lambda_Bq;   ///< per node of the tree; of leaves
  std::vector<DroneModel> drones;  ///< background rates; scales are given
};

/// What one pass over all rows finds out about a state.
struct MapProjection {
  double log_likelihood = 0.0;
  /// What is counted over what is expected, as seen from each leaf (per node of the tree) and from each drone's
  /// background rates: the factors of a step of expectation maximisation. 1 less is the likelihood's slope per count.
  std::vector<double> ratio, singles_ratio, pairs_ratio;
  std::vector<float> root_curvature;  ///< per row, block by block, singles first: sqrt(n) / mu and 1 / f
};

}  // namespace comptonaut
