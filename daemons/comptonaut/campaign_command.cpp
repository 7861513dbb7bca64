// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "campaign_page.h"
#include "commands.h"
#include "output.h"
#include "sim/campaign.h"
#include "sim/campaign_csv.h"
#include "sim/campaign_merge.h"
#include "sim/campaign_summary.h"
#include "sim/load_setup.h"

namespace comptonaut {
namespace {

struct CampaignOptions {
  MissionFiles files;
  std::string seeds = "1";
  std::vector<std::string> strategies;
  std::vector<std::string> estimators;
  std::vector<double> lanes_m;
  bool ideal = false;
  int jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  std::filesystem::path csv;
  std::filesystem::path per_source;
  std::filesystem::path page;
  std::filesystem::path runs;
  std::string shard;
  std::vector<std::filesystem::path> merge;
};

/// Set by SIGINT and SIGTERM; the second one ends the process at once.
volatile std::sig_atomic_t stopped = 0;

void stop_on_signals() {
  struct sigaction action = {};
  action.sa_handler = [](int) { stopped = 1; };
  action.sa_flags = SA_RESETHAND;
  for (const int signal : {SIGINT, SIGTERM}) sigaction(signal, &action, nullptr);
}

/// On stderr: a bar on a terminal, else lines now and then.
class ProgressShown {
 public:
  void show(const CampaignProgress& progress) {
    if (terminal_) return show_progress(progress.share);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin_;
    if (const auto line = lines_.at(progress, elapsed.count())) fmt::print(stderr, "{}", *line);
  }
  void hide() const {
    if (terminal_) hide_progress();
  }

 private:
  bool terminal_ = isatty(STDERR_FILENO) == 1;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  ProgressLines lines_;
};

template <typename Parse>
auto parsed(const std::string& option, const std::string& text, Parse parse) {
  try {
    return parse(text);
  } catch (const std::invalid_argument& wrong) {
    throw std::runtime_error(fmt::format("{} {}: {}", option, text, wrong.what()));
  }
}

template <typename T>
void require_once(const std::string& option, const std::vector<T>& asked) {
  for (auto it = asked.begin(); it != asked.end(); ++it) {
    if (std::find(asked.begin(), it, *it) != it) {
      throw std::runtime_error(fmt::format("{}: {} stands twice", option, *it));
    }
  }
}

/// What the caller asked for, or else the configured value alone.
template <typename T>
std::vector<T> chosen(const std::vector<T>& asked, const T& configured) {
  return asked.empty() ? std::vector<T>{configured} : asked;
}

/// Every strategy with every estimator; a zigzag of each lane.
std::vector<CampaignTeam> teams_of(const CampaignOptions& options) {
  MissionSetup setup = load_setup(options.files);
  if (options.ideal) setup.scenario = idealised(setup.scenario);
  const auto strategies = chosen(options.strategies, setup.coordinator.search.strategy);
  const auto estimators = chosen(options.estimators, setup.coordinator.estimator);
  const auto lanes_m = chosen(options.lanes_m, setup.coordinator.search.zigzag.lane_m);
  std::vector<CampaignTeam> teams;
  const auto add = [&](const std::string& strategy, const std::string& called, double lane_m) {
    for (const std::string& estimator : estimators) {
      setup.coordinator.search.strategy = strategy;
      setup.coordinator.search.zigzag.lane_m = lane_m;
      setup.coordinator.estimator = estimator;
      teams.push_back({.names = {.scenario = setup.scenario.name + (options.ideal ? "-ideal" : ""),
                                 .strategy = called,
                                 .estimator = estimator},
                       .setup = setup});
    }
  };
  for (const std::string& strategy : strategies) {
    if (strategy == "zigzag" && lanes_m.size() > 1) {
      for (const double lane_m : lanes_m) add(strategy, fmt::format("zigzag-{}m", lane_m), lane_m);
    } else {
      add(strategy, strategy, lanes_m.front());
    }
  }
  return teams;
}

/// The files that were asked for, and tables on stdout.
void tell(const CampaignOptions& options, const CampaignFacts& facts, const std::vector<CampaignPart>& parts) {
  write_text(options.csv, campaign_csv(parts));
  write_text(options.per_source, per_source_csv(parts));
  if (!options.page.empty()) write_text(options.page, comparison_html(comparison_of(parts, facts)));
  for (const CampaignPart& part : parts) fmt::print("{}{}", campaign_summary(part), parts.size() > 1 ? "\n" : "");
  if (parts.size() > 1) fmt::print("{}", campaign_comparison(parts));
}

void fly(const CampaignOptions& options) {
  if (options.files.scenario.empty()) throw std::runtime_error("--scenario: what to fly is missing");
  require_once("--strategy", options.strategies);
  require_once("--estimator", options.estimators);
  require_once("--lane-m", options.lanes_m);
  const SeedRange seeds = parsed("--seeds", options.seeds, parse_seeds);
  const Shard shard = options.shard.empty() ? Shard() : parsed("--shard", options.shard, parse_shard);
  if (!options.shard.empty() && options.runs.empty()) {
    throw std::runtime_error("--shard: --runs must say where its runs go, for --merge");
  }
  const std::vector<CampaignTeam> teams = teams_of(options);
  stop_on_signals();
  ProgressShown shown;
  const CampaignResult result = run_campaign(teams, seeds, shard, options.jobs, [&](const CampaignProgress& progress) {
    shown.show(progress);
    return stopped == 0;
  });
  shown.hide();
  const CampaignFacts facts = facts_of(teams, seeds);
  if (!options.runs.empty()) write_text(options.runs, shard_text(facts, shard, result));
  tell(options, facts, result.parts);
  if (result.missing.empty()) return;
  for (const std::string& run : result.missing) fmt::print(stderr, "missing: {}\n", run);
  throw std::runtime_error(fmt::format("{} runs are missing", result.missing.size()));
}

void merge(const CampaignOptions& options) {
  std::vector<ShardText> shards;
  for (const auto& file : options.merge) shards.push_back({.name = file.string(), .text = read_text(file)});
  const MergedCampaign campaign = merge_shards(shards);
  tell(options, campaign.facts, campaign.parts);
}

void campaign(const CampaignOptions& options) {
  require_writable(options.csv);
  require_writable(options.per_source);
  require_writable(options.page);
  require_writable(options.runs);
  if (options.merge.empty()) {
    fly(options);
  } else {
    merge(options);
  }
}

}  // namespace

void add_campaign_command(CLI::App& app) {
  const auto options = std::make_shared<CampaignOptions>();
  CLI::App* command =
      app.add_subcommand("campaign", "Flies a scenario in simulation once per seed, all in one process");
  command->add_option("--scenario", options->files.scenario, "What to fly, YAML");
  command->add_option("--seeds", options->seeds, "FIRST:LAST")->capture_default_str();
  command->add_option("--strategy", options->strategies, "Who leads the team where, one or more: a,b")
      ->delimiter(',')
      ->check(CLI::IsMember(kStrategies));
  command->add_option("--estimator", options->estimators, "What makes sources of events, one or more: a,b")
      ->delimiter(',')
      ->check(CLI::IsMember(kEstimators));
  command->add_option("--lane-m", options->lanes_m, "Distance of the zigzag's lanes, one or more: 2,4")
      ->delimiter(',')
      ->check(CLI::Range(0.1, 1000.0));
  command->add_flag("--ideal", options->ideal, "The truth is what the estimators believe: no mismatch, no traps");
  command->add_option("--csv", options->csv, "One row per configuration, seed and simulated second");
  command->add_option("--per-source", options->per_source, "One row per seed, simulated second and true source");
  command->add_option("--page", options->page, "One HTML page: curves over time, a table, maps of one run");
  command->add_option("--config", options->files.coordinator, "The coordinator's; the daemons' stand beside it")
      ->capture_default_str();
  command->add_option("--jobs", options->jobs, "Missions at a time; does not change the results")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  auto* shard = command->add_option("--shard", options->shard, "I/N: fly every N-th run, for --merge afterwards");
  auto* runs = command->add_option("--runs", options->runs, "The runs themselves, for --merge");
  command->add_option("--merge", options->merge, "--runs of all shards: makes everything else of them, flies nothing")
      ->excludes(shard)
      ->excludes(runs);
  command->callback([options] { campaign(*options); });
}

}  // namespace comptonaut
