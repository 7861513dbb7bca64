// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "flight/plan.h"
#include "flight/team_flight.h"
#include "nodes/coordinator_config.h"
#include "nodes/more_nuclides.h"
#include "response/response_table.h"
#include "search/strategy.h"

namespace comptonaut {

/// What a search needs to know of the mission.
[[nodiscard]] SearchFacts search_facts(const CoordinatorConfig& config, const ResponseTable& response,
                                       const std::vector<MoreNuclide>& more = {});

/// A flight as a plan for one MAV, without its basis; at most plan_waypoints_max points of it. `status` is the
/// course's, the flight's is added to it.
[[nodiscard]] Plan plan_of(const std::string& status, const Flight& flight, std::int32_t mav,
                           const CoordinatorConfig& config, Utime tick, std::int64_t term);

}  // namespace comptonaut
