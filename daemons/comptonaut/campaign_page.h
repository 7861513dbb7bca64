// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "report/comparison.h"
#include "sim/campaign.h"

namespace comptonaut {

/// What the campaign's page shows. The run of its maps is the one with the middle time to success of the first part
/// that has missions, of those whose seed all parts with missions have. Parts without a mission are left out.
[[nodiscard]] Comparison comparison_of(std::span<const CampaignPart> parts, const CampaignFacts& facts);

}  // namespace comptonaut
