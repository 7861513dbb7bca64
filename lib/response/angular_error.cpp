// SPDX-License-Identifier: BSD-3-Clause
#include "response/angular_error.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace comptonaut {
namespace {

double safe_acos(double cosine) { return std::acos(std::clamp(cosine, -1.0, 1.0)); }

std::optional<double> pass_by(const ConeHypothesis& hypothesis, const Eigen::Vector3d& u_D) {
  if (!(hypothesis.probability > 0.0)) return std::nullopt;
  return std::abs(safe_acos(u_D.dot(hypothesis.axis_D)) - safe_acos(hypothesis.cos_beta));
}

double distance2(const Cluster& cluster, const Deposit& deposit, const SensorConfig& sensor) {
  return (pixel_to_D(sensor, cluster.x_px, cluster.y_px) - deposit.p_D).head<2>().squaredNorm();
}

/// The value that this share of the values does not exceed.
double quantile(std::vector<double>& values, double share) {
  if (values.empty()) return 0.0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace

AngularError angular_error(const DetectorEvent& pair, std::span<const Deposit> deposits, const Eigen::Vector3d& u_D,
                           const SensorConfig& sensor) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const auto a = pass_by(pair.a, u_D), b = pass_by(pair.b, u_D);
  AngularError error{.best_rad = std::min(a.value_or(kNone), b.value_or(kNone)), .true_rad = {}, .a_is_true = {}};
  const Deposit& first = deposits.front();
  if (first.process != Process::kCompton) return error;
  error.a_is_true = distance2(pair.first, first, sensor) < distance2(pair.second, first, sensor);
  error.true_rad = *error.a_is_true ? a : b;
  return error;
}

AngularSummary summarize(std::span<const AngularError> errors) {
  std::vector<double> best, truth;
  double with_truth = 0.0, a_is_true = 0.0;
  for (const AngularError& error : errors) {
    best.push_back(error.best_rad);
    if (error.true_rad) truth.push_back(*error.true_rad);
    if (!error.a_is_true) continue;
    with_truth += 1.0;
    a_is_true += *error.a_is_true ? 1.0 : 0.0;
  }
  return {.pairs = static_cast<std::int64_t>(errors.size()),
          .a_is_true = with_truth > 0.0 ? a_is_true / with_truth : 0.0,
          .has_truth = errors.empty() ? 0.0 : with_truth / static_cast<double>(errors.size()),
          .best_median_rad = quantile(best, 0.5),
          .best_q95_rad = quantile(best, 0.95),
          .true_median_rad = quantile(truth, 0.5),
          .true_q95_rad = quantile(truth, 0.95)};
}

}  // namespace comptonaut
