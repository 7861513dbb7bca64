// SPDX-License-Identifier: BSD-3-Clause
#include "physics/shield.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace comptonaut {
namespace {

struct Recipe {
  std::string name;
  double density_g_cm3;
  std::vector<std::pair<int, double>> mass_fraction;  ///< by atomic number; what is left out is shared out
};

const std::vector<Recipe>& recipes() {
  static const std::vector<Recipe> all = {
      {"concrete",
       2.3,
       {{1, 0.0221},
        {6, 0.002484},
        {8, 0.57493},
        {11, 0.015208},
        {12, 0.001266},
        {13, 0.019953},
        {14, 0.304627},
        {19, 0.010045},
        {20, 0.042951},
        {26, 0.006435}}},
      {"brick", 1.8, {{8, 0.525}, {13, 0.005}, {14, 0.449}, {20, 0.014}, {26, 0.007}}},
      {"soil", 1.5, {{8, 0.5326}, {14, 0.4674}}},
      {"wood", 0.64, {{1, 0.0596}, {6, 0.497}, {7, 0.005}, {8, 0.4274}}},
      {"steel", 7.8, {{6, 0.005}, {26, 0.995}}}};
  return all;
}

}  // namespace

std::vector<std::string> Shield::names() {
  std::vector<std::string> result;
  for (const Recipe& recipe : recipes()) result.push_back(recipe.name);
  return result;
}

Shield Shield::load(const std::string& name, const std::filesystem::path& folder) {
  const auto recipe = std::ranges::find(recipes(), name, &Recipe::name);
  if (recipe == recipes().end()) {
    throw std::invalid_argument(fmt::format("material '{}' must be one of {}", name, fmt::join(names(), ", ")));
  }
  double sum = 0.0;
  for (const auto& [z, fraction] : recipe->mass_fraction) sum += fraction;
  Shield shield;
  shield.density_g_cm3_ = recipe->density_g_cm3;
  for (const auto& [z, fraction] : recipe->mass_fraction) {
    shield.components_.push_back({CrossSections::load(z, folder), fraction / sum});
  }
  return shield;
}

double Shield::attenuation_per_m(double energy_keV) const {
  double cm2_g = 0.0;
  for (const Component& part : components_) cm2_g += part.mass_fraction * part.cross_sections.at(energy_keV).total();
  return 100.0 * density_g_cm3_ * cm2_g;
}

}  // namespace comptonaut
