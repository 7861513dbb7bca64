// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/plan_of.h"

namespace comptonaut {

SearchFacts search_facts(const CoordinatorConfig& config, const ResponseTable& response) {
  return {.activity_min_Bq = config.joint.activity_min_Bq,
          .activity_max_Bq = config.joint.activity_max_Bq,
          .single_response = mean_single(response),
          .attenuation_per_m = config.joint.attenuation_per_m,
          .speed_max_m_s = config.speed_max_m_s};
}

Plan plan_of(const Course& course, std::int32_t mav, const CoordinatorConfig& config, Utime tick, std::int64_t term) {
  Plan plan{.mission = config.mission, .utime = tick, .mav = mav, .term = term};
  // Numbers are seconds of data time, so that they also grow when the coordinator starts anew.
  plan.number = tick / kSecond_us;
  plan.status = course.status;
  for (const Eigen::Vector3d& p_W : course.points_W) {
    if (std::ssize(plan.waypoints) == config.plan_waypoints_max) break;
    plan.waypoints.push_back({.p_W = p_W, .speed_max_m_s = config.speed_max_m_s});
  }
  return plan;
}

}  // namespace comptonaut
