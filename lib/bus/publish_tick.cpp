// SPDX-License-Identifier: BSD-3-Clause
#include "bus/publish_tick.h"

namespace comptonaut {

void publish_tick(Bus& bus, PacedPublisher& map, const Coordinator::Tick& tick, const std::string& prefix) {
  for (const Plan& plan : tick.plans) bus.publish(prefix + mav_channel(plan.mav, "PLAN"), plan);
  bus.publish(prefix + "SOURCES", tick.sources);
  bus.publish(prefix + "COORDINATOR", tick.state);
  if (tick.patches) bus.publish(prefix + "PATCHES", *tick.patches);
  for (const MapTile& tile : tick.map) map.publish(prefix + "RADIATION_MAP", tile);
  for (const ClearanceTile& tile : tick.clearance) map.publish(prefix + "RADIATION_CLEARANCE", tile);
}

}  // namespace comptonaut
