// SPDX-License-Identifier: BSD-3-Clause
#include "sim/judgement.h"

#include <cmath>
#include <numbers>

#include "nodes/compare_with_truth.h"

namespace comptonaut {
namespace {

bool lies_on(const Patch& patch, const Eigen::Vector3d& p_W) {
  return std::hypot(p_W.x() - patch.x_m, p_W.y() - patch.y_m) <= patch.radius_m;
}

SourceError error_of(const SourceEstimate& estimate, const TrueSource& truth) {
  return {.x_m = estimate.p_W.x() - truth.p_W.x(),
          .y_m = estimate.p_W.y() - truth.p_W.y(),
          .x_sigma_m = estimate.position_sigma_m.x(),
          .y_sigma_m = estimate.position_sigma_m.y(),
          .activity_rel = (estimate.activity_Bq - truth.activity_Bq) / truth.activity_Bq,
          .activity_rel_sigma = estimate.activity_sigma_Bq / truth.activity_Bq};
}

}  // namespace

Judgement judge(const SourceReport& report, const std::vector<TrueSource>& truth, const Scenario& scenario,
                Utime start_utime) {
  SourceReport outside = report;
  if (scenario.patch) {
    std::erase_if(outside.sources,
                  [&](const SourceEstimate& estimate) { return lies_on(*scenario.patch, estimate.p_W); });
  }
  Judgement judgement{.t_s = seconds(report.utime - start_utime),
                      .coverage = report.coverage,
                      .localisation = compare_with_truth(outside, truth, scenario.area),
                      .reported = compared_estimates(outside, truth.size())};
  judgement.errors.resize(truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const int found_by = judgement.localisation.found_by[i];
    if (found_by >= 0) judgement.errors[i] = error_of(outside.sources[found_by], truth[i]);
  }
  return judgement;
}

std::optional<PatchError> patch_error(const PatchReport& report, const Patch& truth) {
  const double area_m2 = std::numbers::pi * truth.radius_m * truth.radius_m;
  std::optional<PatchError> nearest;
  for (const PatchEstimate& patch : report.patches) {
    const double centroid_m = std::hypot(patch.p_W.x() - truth.x_m, patch.p_W.y() - truth.y_m);
    if (centroid_m > (nearest ? nearest->centroid_m : truth.radius_m)) continue;
    nearest = {.centroid_m = centroid_m,
               .area_rel = patch.area_m2 / area_m2 - 1.0,
               .activity_rel = patch.activity_Bq / truth.activity_Bq - 1.0};
  }
  return nearest;
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
