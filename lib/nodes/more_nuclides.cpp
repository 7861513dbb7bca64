// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/more_nuclides.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <stdexcept>

#include "physics/klein_nishina.h"

namespace comptonaut {
namespace {

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

ChannelTables load_tables(const std::filesystem::path& folder, const std::string& nuclide) {
  const std::string name = lower_case(nuclide);
  const std::filesystem::path response = folder / (name + ".csv"), cones = folder / (name + "-cones.csv");
  for (const auto& file : {response, cones}) {
    if (!std::filesystem::exists(file)) {
      throw std::runtime_error(
          fmt::format("more_nuclides: {} is missing; 'comptonaut response --cones' makes it", file.string()));
    }
  }
  return {.response = ResponseTable::load(response), .cones = ConeDensity::load(cones)};
}

/// `line`: the table of the line whose photons these are.
JointPhysics physics_of(const CoordinatorConfig& config, const ChannelTables& tables, const ResponseTable& line,
                        const ResponseTable& first) {
  return {.response = SmoothResponse(tables.response),
          .cones = ConeTable(tables.cones, config.joint.attitude_sigma_rad),
          .attenuation_per_m = attenuation_per_m(line, first, config.joint.attenuation_per_m),
          .obstacles_per_m = attenuation_per_m(line, first, config.obstacle_attenuation_per_m)};
}

/// Photons that scattered in ground and air come with little energy: they count in the lowest channel alone.
JointConfig above_the_first(JointConfig config) {
  config.scatter_share = 0.0;
  return config;
}

}  // namespace

std::vector<MoreNuclide> load_more_nuclides(const CoordinatorConfig& config) {
  const std::filesystem::path folder = config.response_table.parent_path();
  std::vector<MoreNuclide> nuclides;
  std::vector<std::string> before = {config.nuclide};
  for (const std::string& nuclide : config.more_nuclides) {
    MoreNuclide more{.nuclide = nuclide, .own = load_tables(folder, nuclide), .left = {}};
    for (const std::string& lower : before) more.left.push_back(load_tables(folder, nuclide + "-in-" + lower));
    nuclides.push_back(std::move(more));
    before.push_back(nuclide);
  }
  return nuclides;
}

std::vector<JointChannel> joint_channels(const CoordinatorConfig& config, const ChannelTables& first,
                                         const std::vector<MoreNuclide>& more) {
  std::vector<JointChannel> channels = {{.nuclide = config.nuclide,
                                         .config = config.joint,
                                         .physics = physics_of(config, first, first.response, first.response)}};
  for (const MoreNuclide& nuclide : more) {
    const ResponseTable& line = nuclide.own.response;
    for (std::size_t i = 0; i < channels.size(); ++i) {
      channels[i].physics.of_others.push_back(physics_of(config, nuclide.left.at(i), line, first.response));
    }
    channels.push_back({.nuclide = nuclide.nuclide,
                        .config = above_the_first(config.joint),
                        .physics = physics_of(config, nuclide.own, line, first.response)});
  }
  return channels;
}

double attenuation_per_m(const ResponseTable& table, const ResponseTable& other, double of_other_per_m) {
  const auto line = table.facts().find("line_keV"), other_line = other.facts().find("line_keV");
  if (line == table.facts().end() || other_line == other.facts().end()) return of_other_per_m;
  const double cross_section_m2 = klein_nishina_m2(std::stod(line->second));
  return of_other_per_m * (cross_section_m2 / klein_nishina_m2(std::stod(other_line->second)));
}

}  // namespace comptonaut
