// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "detector/events.h"
#include "response/angular_error.h"
#include "response/cone_density.h"

namespace comptonaut {

/// Where the source of one simulated pair lay about one of its hypotheses.
struct ConeSample {
  double cos_alpha = 0.0;  ///< u . axis
  double cos_beta = 0.0;
  double weight = 1.0;
  Readings readings = Readings::kBoth;
};

/// The samples of one pair, weights of sum 1: the sole reading; of two the true one, or, where the photon did not
/// scatter first and there is none, both by their probabilities.
[[nodiscard]] std::vector<ConeSample> cone_samples(const DetectorEvent& pair, const AngularError& error,
                                                   const Eigen::Vector3d& u_D);

/// Shares of the widths by maximum likelihood, node by node (EM on a mixture of known parts: the problem is concave, so
/// the start does not matter); samples between two nodes count for both, by nearness. A node with less than 200 samples
/// takes the shares of all samples of its readings. The order of samples matters to the last bits only.
/// Throws std::invalid_argument if there are no samples of some readings.
[[nodiscard]] ConeDensity fit_cone_density(std::span<const ConeSample> samples, ConeDensity::Facts facts = {});

}  // namespace comptonaut
