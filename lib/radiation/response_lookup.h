// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiation/view.h"
#include "response/response_table.h"

namespace comptonaut {

/// The table's nearest entries for pairs.
[[nodiscard]] ResponseLookup pair_lookup(ResponseTable table);

}  // namespace comptonaut
