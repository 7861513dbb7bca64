// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "radiation/metrics.h"
#include "sim/scenario.h"

namespace comptonaut {

/// The estimate that a true source was given, minus the truth; NaN where it was not found or has no sigma.
struct SourceError {
  static constexpr double kNone = SourceEstimate::kUnknown;
  double x_m = kNone, y_m = kNone;
  double x_sigma_m = kNone, y_sigma_m = kNone;
  double activity_rel = kNone;        ///< (A - A_true) / A_true
  double activity_rel_sigma = kNone;  ///< sigma_A / A_true
};

/// How the patch that was reported differs from the true one.
struct PatchError {
  double centroid_m = 0.0;    ///< distance
  double area_rel = 0.0;      ///< (area - true area) / true area
  double activity_rel = 0.0;  ///< likewise
};

/// How good the team's answer is at one time step.
struct Judgement {
  double t_s = 0.0;       ///< since the mission's start
  double coverage = 0.0;  ///< share of cells that count as searched
  Localisation localisation;
  std::vector<PointSource> reported = {};   ///< what was compared with the truth
  std::vector<SourceError> errors = {};     ///< per true source
  double crb_m = SourceEstimate::kUnknown;  ///< the Cramer-Rao bound of rmse_m; NaN: not computed
  int patches = 0;                          ///< reported
  std::optional<PatchError> patch = {};     ///< of the scenario's; nullopt: none, or not reported
};

/// Compares a report with the point sources of the truth. A patch is no point source: estimates on it are neither
/// right nor false, and left out (before the strongest are taken, for the estimator `mlem`).
[[nodiscard]] Judgement judge(const SourceReport& report, const std::vector<TrueSource>& truth,
                              const Scenario& scenario, Utime start_utime);

/// Of the nearest reported patch whose centroid lies within the true one; nullopt: there is none.
[[nodiscard]] std::optional<PatchError> patch_error(const PatchReport& report, const Patch& truth);

/// From when on, until the last step, all sources are found within 2 m and no estimate is false; nullopt: never.
[[nodiscard]] std::optional<double> time_to_success_s(std::span<const Judgement> steps);

}  // namespace comptonaut
