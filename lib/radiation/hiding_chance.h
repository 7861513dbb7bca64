// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace comptonaut {

/// The chance that a source whose activity is log-uniform between two values has not given a single event where
/// A sensitivity_s are expected of one of activity A (design, section 6.3):
///   [E1(A_min S) - E1(A_max S)] / ln(A_max / A_min)
/// 1 at S = 0. Activities positive, the first smaller.
[[nodiscard]] double hiding_chance(double sensitivity_s, double activity_min_Bq, double activity_max_Bq);

}  // namespace comptonaut
