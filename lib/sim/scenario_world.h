// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "config/config.h"
#include "core/cells.h"
#include "world/world.h"

namespace comptonaut {

/// The section `world` of a scenario: a file with an OctoMap, a heightmap (read_heightmap), or boxes on flat ground,
/// from which one is made. Boxes have free space about them as far as kWorldMargin_m around the area and up to
/// ceiling_m. Throws ConfigError.
[[nodiscard]] World read_world(Config& config, const Area& area);

inline constexpr double kWorldMargin_m = 12.0;

}  // namespace comptonaut
