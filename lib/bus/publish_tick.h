// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "bus/paced_publisher.h"
#include "nodes/coordinator.h"

namespace comptonaut {

/// Plans, sources and the state at once, then the map as fast as listeners can take it. `prefix` goes before each
/// channel's name.
void publish_tick(Bus& bus, PacedPublisher& map, const Coordinator::Tick& tick, const std::string& prefix);

}  // namespace comptonaut
