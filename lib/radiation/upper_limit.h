// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace comptonaut {

/// What was counted about a source of unknown activity A besides all that is known already:
///   log L(A) = sum_k n_k log(1 + r_k A) - S A
/// up to a constant. Terms whose r_k A stays small may be taken as one that has their first two derivatives at A = 0:
/// r = sum n_k r_k^2 / sum n_k r_k, n = (sum n_k r_k)^2 / sum n_k r_k^2.
struct ActivityEvidence {
  double sensitivity_s = 0.0;         ///< S >= 0: counts expected per Bq
  std::vector<double> ratios_per_Bq;  ///< r_k >= 0: expected per Bq over what is expected anyway
  std::vector<double> counts;         ///< n_k > 0, not necessarily whole
};

/// The activity that the source exceeds with a chance of `chance` under a flat prior on A >= 0 [Helene 1983]:
///   int_0^limit L dA = (1 - chance) int_0^infinity L dA
/// Never below -log(chance) / S, which is the limit of a count of nothing. Infinite without sensitivity.
/// `chance` in (0, 1).
[[nodiscard]] double upper_limit_Bq(const ActivityEvidence& evidence, double chance);

}  // namespace comptonaut
