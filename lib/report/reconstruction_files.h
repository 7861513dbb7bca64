// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/cells.h"
#include "radiation/reconstruction.h"

namespace comptonaut {

/// `x_m,y_m,z_m,lambda_Bq,sensitivity_s`, a row per cell in their order; numbers read back to the same bits.
[[nodiscard]] std::string lambda_csv(const Cells& cells, const Reconstruction& result);

/// The sources with 95 % intervals, what they were made of and how far the estimator came; units are in the names, null
/// is what the estimator does not tell.
[[nodiscard]] std::string sources_json(const Reconstruction& result);

/// Where an activity lies with a probability of 95 %, Bq; both NaN where its sigma is not known.
struct ActivityInterval {
  double low_Bq = 0.0;
  double high_Bq = 0.0;
};
[[nodiscard]] ActivityInterval interval_95(const SourceEstimate& source);

/// Half-axes and direction of the ellipse in which a source lies with a probability of 95 %.
struct PositionEllipse {
  double major_m = 0.0, minor_m = 0.0;
  double direction_rad = 0.0;  ///< of the longer axis, from x (east) towards y (north)
};
/// All NaN where the estimator does not tell.
[[nodiscard]] PositionEllipse ellipse_95(const SourceEstimate& source);

}  // namespace comptonaut
