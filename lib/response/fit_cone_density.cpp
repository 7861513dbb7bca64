// SPDX-License-Identifier: BSD-3-Clause
#include "response/fit_cone_density.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "core/angle.h"

namespace comptonaut {
namespace {

constexpr std::array<double, 13> kNodes_deg = {0, 20, 40, 60, 80, 100, 115, 130, 145, 155, 165, 172.5, 180};
constexpr double kFewest = 200.0;
constexpr double kPrior = 0.5;  // pairs
constexpr int kSteps = 300;

/// Density of each part at one sample, and how much the sample counts.
struct Parts {
  std::array<double, kConeParts> per_sr;
  double weight = 0.0;
};

Parts parts_of(const ConeSample& sample) {
  Parts parts{.per_sr = {}, .weight = sample.weight};
  for (std::size_t i = 0; i < kConeParts; ++i) {
    parts.per_sr[i] = cone_part_per_sr(i, sample.cone.cos_alpha, sample.cone.cos_beta);
  }
  return parts;
}

/// How much a sample at beta counts for a node: falls linearly to 0 at the nodes beside it.
double nearness(std::size_t node, double beta_deg) {
  const double at = kNodes_deg[node];
  if (beta_deg < at) return node == 0 ? 1.0 : 1.0 - (at - beta_deg) / (at - kNodes_deg[node - 1]);
  return node + 1 == kNodes_deg.size() ? 1.0 : 1.0 - (beta_deg - at) / (kNodes_deg[node + 1] - at);
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

ConeWeights expectation_maximisation(const std::vector<Parts>& samples) {
  double total = 0.0;
  for (const Parts& sample : samples) total += sample.weight;
  const double prior = kPrior / effective(samples);
  ConeWeights weights;
  weights.fill(1.0 / kConeParts);
  for (int step = 0; step < kSteps; ++step) {
    ConeWeights sums{};
    for (const Parts& sample : samples) {
      const double density = std::inner_product(weights.begin(), weights.end(), sample.per_sr.begin(), 0.0);
      for (std::size_t i = 0; i < kConeParts; ++i) sums[i] += sample.weight * weights[i] * sample.per_sr[i] / density;
    }
    for (std::size_t i = 0; i < kConeParts; ++i) {
      weights[i] = (sums[i] / total + prior) / (1.0 + kConeParts * prior);
    }
  }
  return weights;
}

std::vector<ConeDensity::Node> fit(std::span<const SimulatedPair> pairs, Readings readings) {
  std::array<std::vector<Parts>, kNodes_deg.size()> of_node;
  for (const SimulatedPair& pair : pairs) {
    for (const ConeSample& sample : cone_samples(pair)) {
      if (sample.readings != readings) continue;
      const double beta_deg = std::acos(std::clamp(sample.cone.cos_beta, -1.0, 1.0)) / kDegree;
      const Parts parts = parts_of(sample);
      for (std::size_t node = 0; node < kNodes_deg.size(); ++node) {
        const double share = nearness(node, beta_deg);
        if (share > 0.0) of_node[node].push_back({.per_sr = parts.per_sr, .weight = share * parts.weight});
      }
    }
  }
  std::vector<ConeDensity::Node> fitted;
  for (std::size_t node = 0; node < kNodes_deg.size(); ++node) {
    const double count = effective(of_node[node]);
    if (count < kFewest) continue;
    fitted.push_back({.beta_rad = kNodes_deg[node] * kDegree,
                      .pairs = std::round(count),
                      .weights = expectation_maximisation(of_node[node])});
  }
  if (fitted.empty()) {
    throw std::invalid_argument(
        fmt::format("cone density: {} pairs are too few to fit it; simulate more photons", pairs.size()));
  }
  return fitted;
}

}  // namespace

std::vector<ConeSample> cone_samples(const SimulatedPair& pair) {
  if (!(pair.a.probability > 0.0)) return {{pair.b, pair.weight, Readings::kSole}};
  if (!(pair.b.probability > 0.0)) return {{pair.a, pair.weight, Readings::kSole}};
  if (pair.a_is_true) return {{*pair.a_is_true ? pair.a : pair.b, pair.weight, Readings::kBoth}};
  return {{pair.a, pair.weight * pair.a.probability, Readings::kBoth},
          {pair.b, pair.weight * pair.b.probability, Readings::kBoth}};
}

ConeDensity fit_cone_density(std::span<const SimulatedPair> pairs, ConeDensity::Facts facts) {
  return ConeDensity(fit(pairs, Readings::kBoth), fit(pairs, Readings::kSole), std::move(facts));
}

}  // namespace comptonaut
