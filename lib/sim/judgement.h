// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "radiation/metrics.h"
#include "sim/scenario.h"

namespace comptonaut {

/// How good the team's answer is at one time step.
struct Judgement {
  double t_s = 0.0;       ///< since the mission's start
  double coverage = 0.0;  ///< share of cells that count as searched
  Localisation localisation;
};

/// Compares a report with the point sources of the truth. A patch is no point source: estimates on it are neither
/// right nor false, and left out (before the strongest are taken, for the estimator `mlem`).
[[nodiscard]] Judgement judge(const SourceReport& report, const std::vector<TrueSource>& truth,
                              const Scenario& scenario, Utime start_utime);

/// From when on, until the last step, all sources are found within 2 m and no estimate is false; nullopt: never.
[[nodiscard]] std::optional<double> time_to_success_s(std::span<const Judgement> steps);

}  // namespace comptonaut
