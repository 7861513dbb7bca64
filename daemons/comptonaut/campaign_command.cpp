// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <thread>

#include "commands.h"
#include "output.h"
#include "sim/campaign.h"
#include "sim/campaign_summary.h"
#include "sim/load_setup.h"

namespace comptonaut {
namespace {

struct CampaignOptions {
  MissionFiles files;
  std::string seeds = "1";
  std::string strategy;
  std::string estimator;
  double lane_m = 0.0;
  bool ideal = false;
  int jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  std::filesystem::path csv;
  std::filesystem::path per_source;
};

SeedRange seeds_of(const CampaignOptions& options) {
  try {
    return parse_seeds(options.seeds);
  } catch (const std::invalid_argument& wrong) {
    throw std::runtime_error(fmt::format("--seeds {}: {}", options.seeds, wrong.what()));
  }
}

MissionSetup setup_of(const CampaignOptions& options) {
  MissionSetup setup = load_setup(options.files);
  if (options.ideal) setup.scenario = idealised(setup.scenario);
  if (!options.strategy.empty()) setup.coordinator.search.strategy = options.strategy;
  if (!options.estimator.empty()) setup.coordinator.estimator = options.estimator;
  if (options.lane_m > 0.0) setup.coordinator.search.zigzag.lane_m = options.lane_m;
  return setup;
}

void campaign(const CampaignOptions& options) {
  const SeedRange seeds = seeds_of(options);
  require_writable(options.csv);
  require_writable(options.per_source);
  const MissionSetup setup = setup_of(options);
  const bool terminal = isatty(STDERR_FILENO) == 1;
  const auto missions = run_campaign(setup, seeds, options.jobs, [&](double share) {
    if (terminal) show_progress(share);
  });
  if (terminal) hide_progress();
  const CampaignNames names{.scenario = setup.scenario.name + (options.ideal ? "-ideal" : ""),
                            .strategy = setup.coordinator.search.strategy,
                            .estimator = setup.coordinator.estimator};
  write_text(options.csv, campaign_csv(names, missions));
  write_text(options.per_source, per_source_csv(missions));
  fmt::print("{}", campaign_summary(names, missions));
}

}  // namespace

void add_campaign_command(CLI::App& app) {
  const auto options = std::make_shared<CampaignOptions>();
  CLI::App* command =
      app.add_subcommand("campaign", "Flies a scenario in simulation once per seed, all in one process");
  command->add_option("--scenario", options->files.scenario, "What to fly, YAML")->required();
  command->add_option("--seeds", options->seeds, "FIRST:LAST")->capture_default_str();
  command->add_option("--strategy", options->strategy, "Who leads the team where; default: as configured")
      ->check(CLI::IsMember({"information", "werner2024", "zigzag", "none"}));
  command->add_option("--estimator", options->estimator, "What makes sources of events; default: as configured")
      ->check(CLI::IsMember({"mlem", "joint"}));
  command->add_option("--lane-m", options->lane_m, "Distance of the zigzag's lanes; default: as configured")
      ->check(CLI::Range(0.1, 1000.0));
  command->add_flag("--ideal", options->ideal, "The truth is what the estimators believe: no mismatch, no traps");
  command->add_option("--csv", options->csv, "One row per seed and simulated second");
  command->add_option("--per-source", options->per_source, "One row per seed, simulated second and true source");
  command->add_option("--config", options->files.coordinator, "The coordinator's; the daemons' stand beside it")
      ->capture_default_str();
  command->add_option("--jobs", options->jobs, "Missions at a time; does not change the results")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->callback([options] { campaign(*options); });
}

}  // namespace comptonaut
