// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/cells.h"
#include "radiation/source_estimate.h"

namespace comptonaut {

/// What fits one datagram.
inline constexpr std::size_t kMaxSources = 32;

/// The highest maxima of a map as sources, highest first, kMaxSources at most. A source's activity is the sum of lambda
/// over the cells within radius_m of its maximum that lie nearer to it than to any other maximum (ties: the higher
/// one), so that no cell counts twice.
[[nodiscard]] std::vector<SourceEstimate> sources_of_map(const Cells& cells, std::span<const double> lambda_Bq,
                                                         std::span<const std::uint32_t> maxima,
                                                         const std::string& nuclide, double radius_m);

}  // namespace comptonaut
