// SPDX-License-Identifier: BSD-3-Clause
#include "sim/judgement.h"

#include <cmath>

#include "nodes/compare_with_truth.h"

namespace comptonaut {
namespace {

bool lies_on(const Patch& patch, const Eigen::Vector3d& p_W) {
  return std::hypot(p_W.x() - patch.x_m, p_W.y() - patch.y_m) <= patch.radius_m;
}

}  // namespace

Judgement judge(const SourceReport& report, const std::vector<TrueSource>& truth, const Scenario& scenario,
                Utime start_utime) {
  SourceReport outside = report;
  if (scenario.patch) {
    std::erase_if(outside.sources,
                  [&](const SourceEstimate& estimate) { return lies_on(*scenario.patch, estimate.p_W); });
  }
  return {.t_s = seconds(report.utime - start_utime),
          .coverage = report.coverage,
          .localisation = compare_with_truth(outside, truth, scenario.area)};
}

std::optional<double> time_to_success_s(std::span<const Judgement> steps) {
  std::optional<double> since_s;
  for (const Judgement& step : steps) {
    if (!all_found_none_false(step.localisation)) {
      since_s.reset();
    } else if (!since_s) {
      since_s = step.t_s;
    }
  }
  return since_s;
}

}  // namespace comptonaut
