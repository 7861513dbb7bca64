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
};

void fit_coordinator(const ScenarioOptions& options) {
  const Scenario scenario = load_scenario(options.scenario);
  write_text(options.out, fitted_coordinator_yaml(scenario, options.coordinator));
  fmt::print("{}\n", scenario.mavs.count);
}

}  // namespace

void add_scenario_command(CLI::App& app) {
  const auto options = std::make_shared<ScenarioOptions>();
  CLI::App* command =
      app.add_subcommand("scenario", "Fits a coordinator's configuration to a scenario; prints the number of MAVs");
  command->add_option("scenario", options->scenario, "Scenario, YAML")->required();
  command->add_option("--coordinator", options->coordinator, "Configuration to start from")->capture_default_str();
  command->add_option("--out", options->out, "Configuration to write")->required();
  command->callback([options] { fit_coordinator(*options); });
}

}  // namespace comptonaut
