// SPDX-License-Identifier: BSD-3-Clause
#include "response/fit_cone_density.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "core/angle.h"

namespace comptonaut {
namespace {

constexpr std::array<double, 13> kNodes_deg = {0, 20, 40, 60, 80, 100, 115, 130, 145, 155, 165, 172.5, 180};
constexpr double kFewest = 200.0;
constexpr int kSteps = 300;

/// Density of each width at one sample, and how much the sample counts.
struct Parts {
  std::array<double, kConeWidths> per_sr;
  double weight = 0.0;
};

Parts parts_of(const ConeSample& sample, double share) {
  Parts parts{.per_sr = {}, .weight = share * sample.weight};
  for (std::size_t i = 0; i < kConeWidths; ++i) {
    parts.per_sr[i] = smeared_ring_per_sr(sample.cos_alpha, sample.cos_beta, cone_sigmas_rad()[i]);
  }
  return parts;
}

/// How much a sample at beta counts for a node: falls linearly to 0 at the nodes beside it.
double nearness(std::size_t node, double beta_deg) {
  const double at = kNodes_deg[node];
  if (beta_deg < at) return node == 0 ? 1.0 : 1.0 - (at - beta_deg) / (at - kNodes_deg[node - 1]);
  return node + 1 == kNodes_deg.size() ? 1.0 : 1.0 - (beta_deg - at) / (kNodes_deg[node + 1] - at);
}

ConeWeights expectation_maximisation(const std::vector<Parts>& samples) {
  ConeWeights weights;
  weights.fill(1.0 / kConeWidths);
  for (int step = 0; step < kSteps; ++step) {
    ConeWeights sums{};
    double total = 0.0;
    for (const Parts& sample : samples) {
      const double density = std::inner_product(weights.begin(), weights.end(), sample.per_sr.begin(), 0.0);
      for (std::size_t i = 0; i < kConeWidths; ++i) sums[i] += sample.weight * weights[i] * sample.per_sr[i] / density;
      total += sample.weight;
    }
    for (std::size_t i = 0; i < kConeWidths; ++i) weights[i] = sums[i] / total;
  }
  return weights;
}

/// As many equally weighted samples as know as much.
double effective(const std::vector<Parts>& samples) {
  double sum = 0.0, sum2 = 0.0;
  for (const Parts& sample : samples) {
    sum += sample.weight;
    sum2 += sample.weight * sample.weight;
  }
  return sum2 > 0.0 ? sum * sum / sum2 : 0.0;
}

std::vector<ConeDensity::Node> fit(std::span<const ConeSample> samples, Readings readings) {
  std::array<std::vector<Parts>, kNodes_deg.size()> of_node;
  std::vector<Parts> all;
  for (const ConeSample& sample : samples) {
    if (sample.readings != readings) continue;
    const double beta_deg = std::acos(std::clamp(sample.cos_beta, -1.0, 1.0)) / kDegree;
    all.push_back(parts_of(sample, 1.0));
    for (std::size_t node = 0; node < kNodes_deg.size(); ++node) {
      const double share = nearness(node, beta_deg);
      if (share <= 0.0) continue;
      of_node[node].push_back(all.back());
      of_node[node].back().weight *= share;
    }
  }
  if (all.empty()) throw std::invalid_argument("cone density: no pairs to fit it to; simulate more photons");
  std::optional<ConeWeights> of_all;
  std::vector<ConeDensity::Node> nodes;
  for (std::size_t node = 0; node < kNodes_deg.size(); ++node) {
    const double pairs = effective(of_node[node]);
    if (pairs < kFewest && !of_all) of_all = expectation_maximisation(all);
    nodes.push_back({.beta_rad = kNodes_deg[node] * kDegree,
                     .pairs = std::round(pairs),
                     .weights = pairs < kFewest ? *of_all : expectation_maximisation(of_node[node])});
  }
  return nodes;
}

}  // namespace

std::vector<ConeSample> cone_samples(const DetectorEvent& pair, const AngularError& error, const Eigen::Vector3d& u_D) {
  const auto sample = [&](const ConeHypothesis& hypothesis, double weight, Readings readings) {
    return ConeSample{u_D.dot(hypothesis.axis_D), hypothesis.cos_beta, weight, readings};
  };
  const double p = pair.a.probability;
  if (!(p > 0.0)) return {sample(pair.b, 1.0, Readings::kSole)};
  if (!(p < 1.0)) return {sample(pair.a, 1.0, Readings::kSole)};
  if (error.a_is_true) return {sample(*error.a_is_true ? pair.a : pair.b, 1.0, Readings::kBoth)};
  return {sample(pair.a, p, Readings::kBoth), sample(pair.b, 1.0 - p, Readings::kBoth)};
}

ConeDensity fit_cone_density(std::span<const ConeSample> samples, ConeDensity::Facts facts) {
  return ConeDensity(fit(samples, Readings::kBoth), fit(samples, Readings::kSole), std::move(facts));
}

}  // namespace comptonaut
