// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/compare_with_truth.h"

namespace comptonaut {

Localisation compare_with_truth(const SourceReport& report, const std::vector<TrueSource>& truth, const Area& area) {
  std::vector<PointSource> points;
  for (const TrueSource& source : truth) {
    points.push_back({.p_W = source.p_W, .activity_Bq = source.activity_Bq, .nuclide = source.nuclide});
  }
  return localise(points, compared_estimates(report, truth.size()), area.diagonal_m());
}

}  // namespace comptonaut
