// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "radiation/source_estimate.h"

namespace comptonaut {

/// A source as the metrics see it, true or estimated.
struct PointSource {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  ///< m
  double activity_Bq = 0.0;
  std::string nuclide = {};  ///< empty where there is only one
};

/// True sources and estimates of one moment, compared, each nuclide's with its own. `found` within a distance is the
/// largest number of true sources that can each be given an estimate of its own that near.
struct Localisation {
  double rmse_nearest_m = 0.0;  ///< over true sources, distance to the nearest estimate [Werner 2024]
  double rmse_m = 0.0;          ///< the least that one estimate per true source can give
  int found_2m = 0;
  int found_half_m = 0;
  int reported = 0;       ///< estimates
  int false_reports = 0;  ///< estimates that no true source within 2 m was given
  /// Median over the sources found within 2 m of |A - A_true| / A_true. NaN: none found.
  double activity_error_rel = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> nearest_m = {};  ///< per true source
  std::vector<int> found_by = {};      ///< per true source: index of its estimate within 2 m, -1: not found
};

inline constexpr double kFoundWithin_m = 2.0;

/// Compares. A true source without an estimate counts as `no_estimate_m` away (the area's diagonal). All zero where
/// there are no true sources, but for the estimates, which are false then.
[[nodiscard]] Localisation localise(std::span<const PointSource> truth, std::span<const PointSource> estimates,
                                    double no_estimate_m);

/// Success: every true source has an estimate of its own within 2 m, and no estimate is false.
[[nodiscard]] bool all_found_none_false(const Localisation& localisation);

/// What of a report is compared with `n_true` true sources: of the estimator "mlem" the n_true strongest, as published,
/// else all.
[[nodiscard]] std::vector<PointSource> compared_estimates(const SourceReport& report, std::size_t n_true);

}  // namespace comptonaut
