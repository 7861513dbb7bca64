// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/plan_of.h"

#include <algorithm>

namespace comptonaut {

SearchFacts search_facts(const CoordinatorConfig& config, const ResponseTable& response) {
  return {.activity_min_Bq = config.joint.activity_min_Bq,
          .activity_max_Bq = config.joint.activity_max_Bq,
          .single_response = mean_single(response),
          .attenuation_per_m = config.joint.attenuation_per_m,
          .obstacles_per_m = config.obstacle_attenuation_per_m,
          .gain_to_add = config.joint.gain_to_add,
          .speed_max_m_s = config.speed_max_m_s,
          .acceleration_max_m_s2 = config.acceleration_max_m_s2};
}

Plan plan_of(const std::string& status, const Flight& flight, std::int32_t mav, const CoordinatorConfig& config,
             Utime tick, std::int64_t term) {
  Plan plan{.mission = config.mission, .utime = tick, .mav = mav, .term = term};
  // Numbers are seconds of data time, so that they also grow when the coordinator starts anew.
  plan.number = tick / kSecond_us;
  plan.status = flight.status.empty() ? status : status + "; " + flight.status;
  const auto n = std::min<std::ptrdiff_t>(std::ssize(flight.waypoints), config.plan_waypoints_max);
  plan.waypoints.assign(flight.waypoints.begin(), flight.waypoints.begin() + n);
  return plan;
}

}  // namespace comptonaut
