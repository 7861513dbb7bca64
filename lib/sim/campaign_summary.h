// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "sim/campaign_part.h"

namespace comptonaut {

/// A campaign in a table for people: time to success, errors and sources found after 60, 120, 220 and 300 s (means
/// over the seeds), shares of events beside the published ones, the smallest distance between MAVs, and how many times
/// faster than real time the missions ran on one thread each.
[[nodiscard]] std::string campaign_summary(const CampaignPart& part);

/// One line per configuration, to compare them: time to success, means over the seeds at the end, the smallest distance
/// between MAVs and the number of runs.
[[nodiscard]] std::string campaign_comparison(std::span<const CampaignPart> parts);

}  // namespace comptonaut
