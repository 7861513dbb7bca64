// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sim/mission_result.h"

namespace comptonaut {

/// What stands in the first columns of each row.
struct CampaignNames {
  std::string scenario;
  std::string strategy;
  std::string estimator;
};

/// All finished missions of one configuration, in the order of the seeds.
struct CampaignPart {
  CampaignNames names;
  std::vector<MissionResult> missions;
};

}  // namespace comptonaut
