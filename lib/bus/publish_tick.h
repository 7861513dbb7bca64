// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "bus/bus.h"
#include "nodes/coordinator.h"

namespace comptonaut {

/// Plans, sources, map and, last, the state: whoever waits for the tick has the rest by then. `prefix` goes before each
/// channel's name.
void publish_tick(Bus& bus, const Coordinator::Tick& tick, const std::string& prefix);

}  // namespace comptonaut
