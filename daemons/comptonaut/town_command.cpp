// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "commands.h"
#include "output.h"
#include "sim/scenario.h"
#include "sim/town.h"

namespace comptonaut {
namespace {

struct TownOptions {
  TownPlan plan;
  std::string size = "60x60x15";
  std::filesystem::path out;
};

void make_town(TownOptions options) {
  TownPlan& plan = options.plan;
  int end = 0;
  const int read = std::sscanf(options.size.c_str(), "%lfx%lfx%lf%n", &plan.x_m, &plan.y_m, &plan.z_m, &end);
  if (read != 3 || end != static_cast<int>(options.size.size())) {
    throw std::runtime_error(fmt::format("--size '{}': must be three lengths in m, such as 60x60x15", options.size));
  }
  const std::string text = town_yaml(plan, fmt::format("town-{}", plan.seed));
  std::filesystem::create_directories(options.out);
  const std::filesystem::path scenario = options.out / "town.yaml", octomap = options.out / "town.bt";
  write_text(scenario, text);
  load_scenario(scenario).world.save(octomap);
  fmt::print("wrote {} and {}\n", scenario.string(), octomap.string());
}

}  // namespace

void add_town_command(CLI::App& app) {
  const auto options = std::make_shared<TownOptions>();
  TownPlan& plan = options->plan;
  CLI::App* command = app.add_subcommand("town", "Makes a scenario with buildings, and the OctoMap of it");
  command->add_option("--seed", plan.seed, "Of the buildings")->capture_default_str();
  command->add_option("--size", options->size, "West to east x south to north x up, m")->capture_default_str();
  command->add_option("--buildings", plan.buildings, "Houses, yards and walls")->capture_default_str();
  command->add_option("--sources", plan.sources, "Half of them behind walls")->capture_default_str();
  command->add_option("--drones", plan.drones, "Of the team")->capture_default_str();
  command->add_option("--out", options->out, "Folder for town.yaml and town.bt")->required();
  command->callback([options] { make_town(*options); });
}

}  // namespace comptonaut
