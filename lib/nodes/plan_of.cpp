// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/plan_of.h"

#include <algorithm>
#include <utility>

namespace comptonaut {

SearchFacts search_facts(const CoordinatorConfig& config, const ResponseTable& response,
                         const std::vector<MoreNuclide>& more) {
  const auto facts_of = [&](const ResponseTable& table, const ResponseTable& line) -> LineFacts {
    return {.single_response = mean_single(table),
            .attenuation_per_m = attenuation_per_m(line, response, config.joint.attenuation_per_m),
            .obstacles_per_m = attenuation_per_m(line, response, config.obstacle_attenuation_per_m)};
  };
  std::vector<ChannelFacts> channels = {{.nuclide = config.nuclide, .lines = {facts_of(response, response)}}};
  for (const MoreNuclide& nuclide : more) {
    const ResponseTable& line = nuclide.own.response;
    for (std::size_t i = 0; i < channels.size(); ++i) {
      channels[i].lines.push_back(facts_of(nuclide.left.at(i).response, line));
    }
    channels.push_back({.nuclide = nuclide.nuclide, .lines = {facts_of(line, line)}});
  }
  return {.activity_min_Bq = config.joint.activity_min_Bq,
          .activity_max_Bq = config.joint.activity_max_Bq,
          .channels = std::move(channels),
          .gain_to_add = config.joint.gain_to_add,
          .speed_max_m_s = config.speed_max_m_s,
          .acceleration_max_m_s2 = config.acceleration_max_m_s2,
          .corner_deviation_max_m = config.corner_deviation_max_m};
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
