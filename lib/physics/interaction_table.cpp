// SPDX-License-Identifier: BSD-3-Clause
#include "physics/interaction_table.h"

#include <algorithm>
#include <cmath>

namespace comptonaut {
namespace {

constexpr std::size_t kNodes = 4096;
const double kNodesPerLog = (kNodes - 1) / std::log(InteractionTable::kMax_keV / InteractionTable::kMin_keV);

double node_keV(std::size_t node) {
  const double energy_keV = InteractionTable::kMin_keV * std::exp(static_cast<double>(node) / kNodesPerLog);
  return std::min(energy_keV, InteractionTable::kMax_keV);
}

}  // namespace

InteractionTable::InteractionTable(const Material& material) : choices_(kProcesses * material.components.size()) {
  cumulative_.reserve(kNodes * choices_);
  for (std::size_t node = 0; node < kNodes; ++node) {
    double sum = 0.0;
    for (const Material::Component& part : material.components) {
      const Coefficients cm2_g = part.cross_sections.at(node_keV(node));
      for (const double value : cm2_g.value) {
        sum += 100.0 * material.density_g_cm3 * part.mass_fraction * value;
        cumulative_.push_back(sum);
      }
    }
  }
}

InteractionTable::Place InteractionTable::place(double energy_keV) {
  const double at = std::clamp(std::log(energy_keV / kMin_keV) * kNodesPerLog, 0.0, kNodes - 1.0);
  const auto node = std::min(static_cast<std::size_t>(at), kNodes - 2);
  return {.node = node, .fraction = at - static_cast<double>(node)};
}

double InteractionTable::attenuation_per_m(const Place& place) const {
  const double* low = &cumulative_[place.node * choices_];
  const double a = low[choices_ - 1], b = low[2 * choices_ - 1];
  return a + place.fraction * (b - a);
}

InteractionTable::Choice InteractionTable::sample(const Place& place, Random& random) const {
  const double* low = &cumulative_[place.node * choices_];
  const double draw = random.uniform() * attenuation_per_m(place);
  std::size_t i = 0;
  while (i + 1 < choices_ && draw >= low[i] + place.fraction * (low[i + choices_] - low[i])) ++i;
  return {.process = static_cast<Process>(i % kProcesses), .component = i / kProcesses};
}

}  // namespace comptonaut
