// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "commands.h"
#include "output.h"
#include "sim/fit.h"

namespace comptonaut {
namespace {

struct ScenarioOptions {
  std::filesystem::path scenario;
  std::filesystem::path coordinator = "config/coordinator.yaml";
  std::filesystem::path out;
  std::filesystem::path pose_bridge = "config/pose-bridge.yaml";
  std::filesystem::path pose_bridge_out;
  std::filesystem::path mapper = "config/mapper.yaml";
  std::filesystem::path mapper_out;
};

void fit_coordinator(const ScenarioOptions& options) {
  const Scenario scenario = load_scenario(options.scenario);
  std::filesystem::path octomap = options.out;
  octomap.replace_extension(".bt");
  write_text(options.out, fitted_coordinator_yaml(scenario, options.coordinator, octomap));
  if (!scenario.team_world().is_flat()) scenario.team_world().save(octomap);
  if (!options.pose_bridge_out.empty()) {
    write_text(options.pose_bridge_out, fitted_pose_bridge_yaml(scenario, options.pose_bridge));
  }
  if (!options.mapper_out.empty()) {
    write_text(options.mapper_out, fitted_mapper_yaml(scenario, options.mapper, octomap));
  }
  fmt::print("{}\n", scenario.mavs.count);
}

}  // namespace

void add_scenario_command(CLI::App& app) {
  const auto options = std::make_shared<ScenarioOptions>();
  CLI::App* command = app.add_subcommand("scenario", "Fits configurations to a scenario; prints the number of MAVs");
  command->add_option("scenario", options->scenario, "Scenario, YAML")->required();
  command->add_option("--coordinator", options->coordinator, "Configuration to start from")->capture_default_str();
  command
      ->add_option("--out", options->out,
                   "Configuration to write; beside it, as .bt, the team's map where it is not flat")
      ->required();
  command->add_option("--pose-bridge", options->pose_bridge, "The drones' configuration to start from")
      ->capture_default_str();
  command->add_option("--pose-bridge-out", options->pose_bridge_out, "The drones' configuration to write");
  command->add_option("--mapper", options->mapper, "The mappers' configuration to start from")->capture_default_str();
  command->add_option("--mapper-out", options->mapper_out, "The mappers' configuration to write");
  command->callback([options] { fit_coordinator(*options); });
}

}  // namespace comptonaut
