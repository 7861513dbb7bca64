// SPDX-License-Identifier: BSD-3-Clause
#include "core/statistics.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace comptonaut {

double median(std::vector<double> values) { return quantile(std::move(values), 0.5); }

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const double at = q * static_cast<double>(values.size() - 1);
  const auto low = std::min(static_cast<std::size_t>(at), values.size() - 1);
  const double share = at - static_cast<double>(low);
  const double high = values[std::min(low + 1, values.size() - 1)];
  return share == 0.0 || values[low] == high ? values[low] : values[low] + share * (high - values[low]);
}

}  // namespace comptonaut
