// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <map>
#include <vector>

#include "nodes/dispatch.h"
#include "start_time.h"
#include "world/world.h"

namespace comptonaut {

/// MAVs that hover, or fly to the last waypoint within a second.
struct Team {
  CoordinatorConfig config;
  Dispatch dispatch{config, {}};
  Cells cells = flat_cells(config.area, 1.0);
  World world = World::flat();
  std::vector<double> zeros = std::vector<double>(cells.size(), 0.0);
  std::vector<SourceEstimate> sources = {};
  std::map<std::int32_t, Eigen::Vector3d> places_W;
  Utime utime = kStart_us;
  bool fly = false;
  double battery_percent = std::numeric_limits<double>::quiet_NaN();
  double used_percent_s = 0.0;  ///< of each battery
  bool alive = true;            ///< the detectors

  std::vector<Plan> tick() {
    dispatch.begin_tick();
    utime += kSecond_us;
    battery_percent -= used_percent_s;
    for (const auto& [mav, p_W] : places_W) {
      dispatch.see({.key = {.mission = 1, .sender = mav},
                    .utime = utime - kBatch_us,
                    .live_us = alive ? 50'000 : 0,
                    .p_WD = p_W,
                    .battery_percent = battery_percent});
    }
    std::vector<Plan> plans = dispatch.plans({cells, world, zeros, zeros, sources}, utime, 1);
    for (const Plan& plan : plans) {
      if (fly && !plan.waypoints.empty() && places_W.contains(plan.mav)) places_W[plan.mav] = plan.waypoints.back().p_W;
    }
    return plans;
  }
  std::vector<Plan> ticks(int n) {
    std::vector<Plan> plans;
    for (int i = 0; i < n; ++i) plans = tick();
    return plans;
  }
};

inline CoordinatorConfig zigzag() {
  CoordinatorConfig config;
  config.search.strategy = "zigzag";
  config.search.route.fence.border = polygon_of(config.area, 10.0);
  return config;
}

}  // namespace comptonaut
