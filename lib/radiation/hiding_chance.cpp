// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/hiding_chance.h"

#include <cmath>

namespace comptonaut {

double hiding_chance(double sensitivity_s, double activity_min_Bq, double activity_max_Bq) {
  if (!(sensitivity_s > 0.0)) return 1.0;
  const auto e1 = [](double x) { return x > 700.0 ? 0.0 : -std::expint(-x); };
  return (e1(activity_min_Bq * sensitivity_s) - e1(activity_max_Bq * sensitivity_s)) /
         std::log(activity_max_Bq / activity_min_Bq);
}

}  // namespace comptonaut
