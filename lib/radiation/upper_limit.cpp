// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/upper_limit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace comptonaut {
namespace {

constexpr std::size_t kGridPoints = 33;
constexpr double kEnough = 9.0;  // log likelihood below its largest where nothing is left to integrate

struct Slope {
  double first = 0.0, second = 0.0;  ///< derivatives of log L
};

Slope slope_at(const ActivityEvidence& e, double A) {
  Slope slope{.first = -e.sensitivity_s};
  for (std::size_t k = 0; k < e.counts.size(); ++k) {
    const double ratio = e.ratios_per_Bq[k] / (1.0 + e.ratios_per_Bq[k] * A);
    slope.first += e.counts[k] * ratio;
    slope.second -= e.counts[k] * ratio * ratio;
  }
  return slope;
}

/// log L is concave and its slope convex: Newton's steps from below never overshoot the largest.
double most_likely_Bq(const ActivityEvidence& e) {
  double A = 0.0;
  for (int step = 0; step < 30; ++step) {
    const Slope slope = slope_at(e, A);
    if (slope.first <= 0.0 || slope.second >= 0.0) return A;
    const double move = -slope.first / slope.second;
    A += move;
    if (move < 1e-3 * A) return A;
  }
  return A;
}

/// log L at evenly spaced activities, from its slopes, less its largest value.
std::array<double, kGridPoints> log_likelihoods(const ActivityEvidence& e, double begin_Bq, double end_Bq) {
  const double h = (end_Bq - begin_Bq) / (kGridPoints - 1);
  std::array<double, kGridPoints> result{};
  Slope before = slope_at(e, begin_Bq);
  for (std::size_t i = 1; i < kGridPoints; ++i) {
    const Slope here = slope_at(e, begin_Bq + h * static_cast<double>(i));
    result[i] = result[i - 1] + 0.5 * h * (before.first + here.first) + h * h / 12.0 * (before.second - here.second);
    before = here;
  }
  const double largest = *std::max_element(result.begin(), result.end());
  for (double& log_l : result) log_l -= largest;
  return result;
}

/// Integral of exp over a step along which the exponent goes straight from a to b.
double exp_step(double a, double b, double h) {
  return std::abs(b - a) < 1e-6 ? h * std::exp(0.5 * (a + b)) : h * (std::exp(b) - std::exp(a)) / (b - a);
}

}  // namespace

double upper_limit_Bq(const ActivityEvidence& e, double chance) {
  if (!(e.sensitivity_s > 0.0)) return std::numeric_limits<double>::infinity();
  const double peak_Bq = most_likely_Bq(e);
  const Slope at = slope_at(e, peak_Bq);
  const double width_Bq = std::min(at.second < 0.0 ? std::sqrt(2.0 * kEnough / -at.second) : 1e300,
                                   at.first < 0.0 ? kEnough / -at.first : 1e300);
  const double begin_Bq = std::max(0.0, peak_Bq - width_Bq);
  double end_Bq = peak_Bq + width_Bq;
  std::array<double, kGridPoints> log_l = log_likelihoods(e, begin_Bq, end_Bq);
  for (int longer = 0; longer < 60 && log_l.back() > -kEnough; ++longer) {
    end_Bq += 0.5 * (end_Bq - begin_Bq);
    log_l = log_likelihoods(e, begin_Bq, end_Bq);
  }
  const double h = (end_Bq - begin_Bq) / (kGridPoints - 1);
  double all = 0.0;
  for (std::size_t i = 1; i < kGridPoints; ++i) all += exp_step(log_l[i - 1], log_l[i], h);
  double above = chance * all;
  for (std::size_t i = kGridPoints - 1; i > 0; --i) {
    const double step = exp_step(log_l[i - 1], log_l[i], h);
    if (step < above) {
      above -= step;
      continue;
    }
    // Within this step: exp grows towards its lower end; `above` of it is beyond the limit.
    const double slope = (log_l[i] - log_l[i - 1]) / h, top = std::exp(log_l[i]);
    const double back = std::abs(slope * h) < 1e-6 ? above / top : -std::log1p(-above * slope / top) / slope;
    return begin_Bq + h * static_cast<double>(i) - back;
  }
  return begin_Bq;
}

}  // namespace comptonaut
