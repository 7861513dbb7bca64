// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "config/config.h"
#include "core/cells.h"

namespace comptonaut {

/// `x_min_m`, `x_max_m`, `y_min_m`, `y_max_m`, all required; at least 1 m each way, within 100 km of the origin.
[[nodiscard]] Area read_area(Config& config);

}  // namespace comptonaut
