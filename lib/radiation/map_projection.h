// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

namespace comptonaut {

/// Projections along one row of floats of padded length n, summed in double in fixed lanes: the same bits on every
/// processor.
[[nodiscard]] double row_dot(const float* row, const double* x, std::size_t n);
/// u[k] += factor row[k]. Meanwhile `next`, as long a row that is read after it, is fetched to the cache.
void row_spread(const float* row, double factor, double* u, std::size_t n, const float* next);
/// picked[k] = row[at[k]] weight[k] factor. Meanwhile as much of `next`, another row, is fetched.
void row_pick(const float* row, const std::uint32_t* at, const float* weight, float factor, float* picked,
              std::size_t n, const float* next);

}  // namespace comptonaut
