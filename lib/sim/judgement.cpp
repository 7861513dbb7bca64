// SPDX-License-Identifier: BSD-3-Clause
#include "sim/judgement.h"

#include <cmath>

namespace comptonaut {
namespace {

bool lies_on(const Patch& patch, const Eigen::Vector3d& p_W) {
  return std::hypot(p_W.x() - patch.x_m, p_W.y() - patch.y_m) <= patch.radius_m;
}

std::vector<PointSource> points(const std::vector<TrueSource>& truth) {
  std::vector<PointSource> result;
  for (const TrueSource& source : truth) result.push_back({.p_W = source.p_W, .activity_Bq = source.activity_Bq});
  return result;
}

}  // namespace

Judgement judge(const SourceReport& report, const std::vector<TrueSource>& truth, const Scenario& scenario,
                Utime start_utime) {
  SourceReport outside = report;
  if (scenario.patch) {
    std::erase_if(outside.sources,
                  [&](const SourceEstimate& estimate) { return lies_on(*scenario.patch, estimate.p_W); });
  }
  return {
      .t_s = seconds(report.utime - start_utime),
      .coverage = report.coverage,
      .localisation = localise(points(truth), compared_estimates(outside, truth.size()), scenario.area.diagonal_m())};
}

std::optional<double> time_to_success_s(std::span<const Judgement> steps) {
  std::optional<double> since_s;
  for (const Judgement& step : steps) {
    const Localisation& found = step.localisation;
    const bool success = found.found_2m == static_cast<int>(found.nearest_m.size()) && found.false_reports == 0;
    if (!success) since_s.reset();
    if (success && !since_s) since_s = step.t_s;
  }
  return since_s;
}

}  // namespace comptonaut
