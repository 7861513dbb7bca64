// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace comptonaut {

/// The middle value, or the mean of the two middle ones; NaN where there is none. Infinities are allowed.
[[nodiscard]] double median(std::vector<double> values);

/// The value below which a share q in 0..1 of the values lies, in a straight line between the two nearest ones: 0 the
/// least, 1 the greatest. NaN where there is none. Infinities are allowed.
[[nodiscard]] double quantile(std::vector<double> values, double q);

}  // namespace comptonaut
