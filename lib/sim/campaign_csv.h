// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "sim/campaign_part.h"

namespace comptonaut {

/// One row per configuration, seed and simulated second. An empty field: not defined (activity_error_rel while nothing
/// is found).
[[nodiscard]] std::string campaign_csv(std::span<const CampaignPart> parts);

/// One row per seed, simulated second and true source (counted from 1): the distance to the nearest estimate, m; the
/// area's diagonal where there is no estimate. Where there are several configurations, their names stand in front.
[[nodiscard]] std::string per_source_csv(std::span<const CampaignPart> parts);

}  // namespace comptonaut
