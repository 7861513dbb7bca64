// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace comptonaut {

/// Projections along one row of floats of padded length n, summed in double in fixed lanes: the same bits on every
/// processor.
[[nodiscard]] double row_dot(const float* row, const double* x, std::size_t n);
/// u[k] += factor row[k].
void row_spread(const float* row, double factor, double* u, std::size_t n);

}  // namespace comptonaut
