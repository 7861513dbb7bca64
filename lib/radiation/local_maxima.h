// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/cells.h"

namespace comptonaut {

/// The cells whose value is positive and not exceeded by any neighbour, highest first, ties by index. Cells of one
/// value that touch each other are one plateau, and one maximum if no neighbour of the plateau is higher: its cell with
/// the lowest index. `value` has at least as many elements as there are cells.
[[nodiscard]] std::vector<std::uint32_t> local_maxima(const Cells& cells, std::span<const double> value);

}  // namespace comptonaut
