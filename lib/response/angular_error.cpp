// SPDX-License-Identifier: BSD-3-Clause
#include "response/angular_error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace comptonaut {
namespace {

double safe_acos(double cosine) { return std::acos(std::clamp(cosine, -1.0, 1.0)); }

ConeView view(const ConeHypothesis& hypothesis, const Eigen::Vector3d& u_D) {
  return {
      .cos_alpha = u_D.dot(hypothesis.axis_D), .cos_beta = hypothesis.cos_beta, .probability = hypothesis.probability};
}

double distance2(const Cluster& cluster, const Deposit& deposit, const SensorConfig& sensor) {
  return (pixel_to_D(sensor, cluster.x_px, cluster.y_px) - deposit.p_D).head<2>().squaredNorm();
}

/// Values and how much each counts.
using Weighted = std::vector<std::pair<double, double>>;

double total(const Weighted& values) {
  double sum = 0.0;
  for (const auto& [value, weight] : values) sum += weight;
  return sum;
}

/// The value that this share of the values does not exceed.
double quantile(Weighted& values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const double below = share * total(values);
  double sum = 0.0;
  for (const auto& [value, weight] : values) {
    sum += weight;
    if (sum >= below) return value;
  }
  return values.back().first;
}

}  // namespace

double delta_rad(const ConeView& cone) { return safe_acos(cone.cos_alpha) - safe_acos(cone.cos_beta); }

SimulatedPair compare_with_photon(const DetectorEvent& pair, std::span<const Deposit> deposits,
                                  const Eigen::Vector3d& u_D, const SensorConfig& sensor) {
  SimulatedPair result{.a = view(pair.hypotheses->a, u_D), .b = view(pair.hypotheses->b, u_D), .a_is_true = {}};
  const Deposit& first = deposits.front();
  if (first.process == Process::kCompton) {
    result.a_is_true = distance2(pair.first, first, sensor) < distance2(pair.second, first, sensor);
  }
  return result;
}

double best_error_rad(const SimulatedPair& pair) {
  double best_rad = std::numeric_limits<double>::infinity();
  for (const ConeView* cone : {&pair.a, &pair.b}) {
    if (cone->probability > 0.0) best_rad = std::min(best_rad, std::abs(delta_rad(*cone)));
  }
  return best_rad;
}

std::optional<double> true_error_rad(const SimulatedPair& pair) {
  if (!pair.a_is_true) return std::nullopt;
  const ConeView& cone = *pair.a_is_true ? pair.a : pair.b;
  return cone.probability > 0.0 ? std::optional(std::abs(delta_rad(cone))) : std::nullopt;
}

AngularSummary summarize(std::span<const SimulatedPair> pairs) {
  Weighted best, truth;
  double with_truth = 0.0, a_is_true = 0.0;
  for (const SimulatedPair& pair : pairs) {
    best.emplace_back(best_error_rad(pair), pair.weight);
    if (const auto error_rad = true_error_rad(pair)) truth.emplace_back(*error_rad, pair.weight);
    if (!pair.a_is_true) continue;
    with_truth += pair.weight;
    a_is_true += *pair.a_is_true ? pair.weight : 0.0;
  }
  return {.pairs = static_cast<std::int64_t>(pairs.size()),
          .a_is_true = with_truth > 0.0 ? a_is_true / with_truth : 0.0,
          .has_truth = pairs.empty() ? 0.0 : with_truth / total(best),
          .best_median_rad = quantile(best, 0.5),
          .best_q95_rad = quantile(best, 0.95),
          .true_median_rad = quantile(truth, 0.5),
          .true_q95_rad = quantile(truth, 0.95)};
}

std::vector<ReliabilityBin> reliability(std::span<const SimulatedPair> pairs) {
  constexpr int kBins = 10;
  std::vector<ReliabilityBin> bins;
  for (int i = 0; i <= kBins; ++i) {
    bins.push_back({.from = static_cast<double>(i) / kBins, .to = std::min(1.0, (i + 1.0) / kBins)});
  }
  for (const SimulatedPair& pair : pairs) {
    for (const bool is_a : {true, false}) {
      const double stated = is_a ? pair.a.probability : pair.b.probability;
      if (!(stated > 0.0)) continue;
      ReliabilityBin& bin =
          bins[static_cast<std::size_t>(stated < 1.0 ? std::min(kBins * stated, kBins - 1.0) : kBins)];
      bin.hypotheses += 1.0;
      bin.weight += pair.weight;
      bin.stated += pair.weight * stated;
      bin.is_true += pair.a_is_true == is_a ? pair.weight : 0.0;
    }
  }
  for (ReliabilityBin& bin : bins) {
    if (!(bin.weight > 0.0)) continue;
    bin.stated /= bin.weight;
    bin.is_true /= bin.weight;
  }
  return bins;
}

}  // namespace comptonaut
