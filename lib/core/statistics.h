// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace comptonaut {

/// The middle value, or the mean of the two middle ones; NaN where there is none. Infinities are allowed.
[[nodiscard]] double median(std::vector<double> values);

}  // namespace comptonaut
