// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/cells.h"
#include "nodes/truth.h"
#include "radiation/metrics.h"

namespace comptonaut {

/// The estimates of a report that count (see compared_estimates) against the true sources. A source without an estimate
/// counts as the area's diagonal away.
[[nodiscard]] Localisation compare_with_truth(const SourceReport& report, const std::vector<TrueSource>& truth,
                                              const Area& area);

}  // namespace comptonaut
