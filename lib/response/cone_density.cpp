// SPDX-License-Identifier: BSD-3-Clause
#include "response/cone_density.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/angle.h"

namespace comptonaut {
namespace {

/// exp(-x) I_0(x) for x >= 0, relative error below 2e-7  [Abramowitz and Stegun 1964, 9.8.1 and 9.8.2].
double scaled_bessel_i0(double x) {
  if (x < 3.75) {
    const double t = x * x / (3.75 * 3.75);
    const double series =
        1.0 + t * (3.5156229 + t * (3.0899424 + t * (1.2067492 + t * (0.2659732 + t * (0.0360768 + t * 0.0045813)))));
    return std::exp(-x) * series;
  }
  const double t = 3.75 / x;
  const double series =
      0.39894228 +
      t * (0.01328592 +
           t * (0.00225319 +
                t * (-0.00157565 +
                     t * (0.00916281 + t * (-0.02057706 + t * (0.02635537 + t * (-0.01647633 + t * 0.00392377)))))));
  return series / std::sqrt(x);
}

/// kappa / (4 pi sinh kappa) exp(kappa): what is left of it where the exponent is counted from its largest value.
double ring_factor(double kappa) {
  if (kappa < 1e-9) return 0.25 / std::numbers::pi;
  return kappa / (2.0 * std::numbers::pi * -std::expm1(-2.0 * kappa));
}

double kappa_of(double sigma_rad, double extra_sigma_rad) {
  return 1.0 / (sigma_rad * sigma_rad + extra_sigma_rad * extra_sigma_rad);  // infinite sigma: 0
}

double sine(double cosine) { return std::sqrt(std::fmax(1.0 - cosine * cosine, 0.0)); }

void check_nodes(const std::vector<ConeDensity::Node>& nodes, const char* name) {
  if (nodes.empty()) throw std::invalid_argument(fmt::format("cone density: no row of '{}'", name));
  double before_rad = -1.0;
  for (const ConeDensity::Node& node : nodes) {
    double sum = 0.0;
    bool valid = node.beta_rad > before_rad && node.beta_rad >= 0.0 && node.beta_rad <= std::numbers::pi + 1e-9 &&
                 node.pairs >= 0.0 && std::isfinite(node.pairs);
    for (const double weight : node.weights) {
      valid = valid && weight >= 0.0;
      sum += weight;
    }
    if (!valid || !(std::abs(sum - 1.0) < 1e-6)) {
      throw std::invalid_argument(
          fmt::format("cone density: '{}' at beta {} rad: beta must grow from row to row within 0 to pi, shares be not "
                      "negative and sum to 1 (they sum to {})",
                      name, node.beta_rad, sum));
    }
    before_rad = node.beta_rad;
  }
}

}  // namespace

const std::array<double, kConeParts>& cone_sigmas_rad() {
  static constexpr std::array<double, kConeParts> kSigmas = {
      0.7 * kDegree,  1.4 * kDegree,  2.8 * kDegree, 5.6 * kDegree,
      11.2 * kDegree, 22.4 * kDegree, 45 * kDegree,  std::numeric_limits<double>::infinity(),
      15.0 * kDegree, 30.0 * kDegree};
  return kSigmas;
}

double smeared_ring_per_sr(double cos_alpha, double cos_beta, double sigma_rad) {
  const double kappa = kappa_of(sigma_rad, 0.0);
  const double sines = sine(cos_alpha) * sine(cos_beta);
  return ring_factor(kappa) * std::exp(kappa * (cos_alpha * cos_beta + sines - 1.0)) * scaled_bessel_i0(kappa * sines);
}

double cone_part_per_sr(std::size_t part, double cos_alpha, double cos_beta) {
  return smeared_ring_per_sr(cos_alpha, part < kConeRings ? cos_beta : 1.0, cone_sigmas_rad()[part]);
}

ConeProfile::ConeProfile(double cos_beta, const ConeWeights& weights, double extra_sigma_rad)
    : cos_beta_(std::clamp(cos_beta, -1.0, 1.0)), sin_beta_(sine(cos_beta_)) {
  for (std::size_t i = 0; i < kConeParts; ++i) {
    const double kappa = kappa_of(cone_sigmas_rad()[i], extra_sigma_rad);
    parts_[i] = {.kappa = kappa, .factor = weights[i] * ring_factor(kappa)};
  }
}

double ConeProfile::per_sr(double cos_alpha) const {
  constexpr double kNothing = -40.0;  // exp: 4e-18
  const double sines = sine(cos_alpha) * sin_beta_;
  const double cos_delta_less_1 = cos_alpha * cos_beta_ + sines - 1.0;
  double sum = 0.0;
  for (std::size_t i = 0; i < kConeRings; ++i) {
    const double exponent = parts_[i].kappa * cos_delta_less_1;
    if (exponent > kNothing) sum += parts_[i].factor * std::exp(exponent) * scaled_bessel_i0(parts_[i].kappa * sines);
  }
  for (std::size_t i = kConeRings; i < kConeParts; ++i) {
    sum += parts_[i].factor * std::exp(parts_[i].kappa * (cos_alpha - 1.0));
  }
  return sum;
}

double ConeProfile::per_rad(double delta_rad) const {
  const double alpha_rad = std::acos(cos_beta_) + delta_rad;
  if (alpha_rad < 0.0 || alpha_rad > std::numbers::pi) return 0.0;
  return 2.0 * std::numbers::pi * std::sin(alpha_rad) * per_sr(std::cos(alpha_rad));
}

ConeDensity::ConeDensity(std::vector<Node> both, std::vector<Node> sole, Facts facts)
    : both_(std::move(both)), sole_(std::move(sole)), facts_(std::move(facts)) {
  check_nodes(both_, "both");
  check_nodes(sole_, "sole");
}

ConeProfile ConeDensity::profile(double cos_beta, Readings readings, double extra_sigma_rad) const {
  const std::vector<Node>& all = nodes(readings);
  const double beta_rad = std::acos(std::clamp(cos_beta, -1.0, 1.0));
  const auto above = std::find_if(all.begin(), all.end(), [&](const Node& node) { return node.beta_rad > beta_rad; });
  if (above == all.begin()) return {cos_beta, all.front().weights, extra_sigma_rad};
  if (above == all.end()) return {cos_beta, all.back().weights, extra_sigma_rad};
  const Node &low = *(above - 1), &high = *above;
  const double share = (beta_rad - low.beta_rad) / (high.beta_rad - low.beta_rad);
  ConeWeights weights;
  for (std::size_t i = 0; i < kConeParts; ++i) {
    weights[i] = (1.0 - share) * low.weights[i] + share * high.weights[i];
  }
  return {cos_beta, weights, extra_sigma_rad};
}

}  // namespace comptonaut
