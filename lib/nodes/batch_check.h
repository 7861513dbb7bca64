// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/cells.h"
#include "radiation/measurement_batch.h"

namespace comptonaut {

/// Whether a batch can be true: numbers finite, directions unit, live time within its duration, the detector not
/// absurdly far from the area, cones where the detector is. What it says is folded for good, so doubt means no.
[[nodiscard]] bool is_sane(const MeasurementBatch& batch, const Area& area);

}  // namespace comptonaut
