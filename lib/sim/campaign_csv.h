// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "sim/mission_result.h"

namespace comptonaut {

/// What stands in the first columns of each row.
struct CampaignNames {
  std::string scenario;
  std::string strategy;
  std::string estimator;
};

/// One row per seed and simulated second. An empty field: not defined (activity_error_rel while nothing is found).
[[nodiscard]] std::string campaign_csv(const CampaignNames& names, std::span<const MissionResult> missions);

/// One row per seed, simulated second and true source (counted from 1): the distance to the nearest estimate, m; the
/// area's diagonal where there is no estimate.
[[nodiscard]] std::string per_source_csv(std::span<const MissionResult> missions);

}  // namespace comptonaut
