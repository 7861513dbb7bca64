// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "radiation/system_rows.h"

namespace comptonaut {

/// One step of expectation maximisation [Shepp and Vardi 1982; Werner 2024]:
///   lambda_j <- lambda_j / s_j sum_i t_ij / sum_k t_ik lambda_k
/// Rows that lambda does not reach, and cells with s_j = 0, count nothing. Spans have padded(cells) elements, zero in
/// the padding.
void mlem_step(const SystemRows& rows, std::span<const double> sensitivity_s, std::span<double> lambda_Bq);

/// lambda after so many steps, at least one, from a uniform start, padded. All zeros without rows.
[[nodiscard]] std::vector<double> mlem(const SystemRows& rows, std::span<const double> sensitivity_s, int iterations);

}  // namespace comptonaut
