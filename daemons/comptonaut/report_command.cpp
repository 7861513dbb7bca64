// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <vector>

#include "commands.h"
#include "config/config.h"
#include "nodes/coordinator_config.h"
#include "report/page.h"
#include "report/read_mission.h"
#include "report/scores.h"
#include "report/source_list.h"
#include "world/footprint.h"

namespace comptonaut {
namespace {

struct ReportOptions {
  std::filesystem::path log;
  std::filesystem::path out = "report.html";
  std::filesystem::path config;
};

/// Of the terrain in the coordinator's configuration.
std::vector<Area> buildings(const std::filesystem::path& config_file) {
  if (config_file.empty()) return {};
  const CoordinatorConfig config = load_config(config_file, read_coordinator_config);
  return footprint(load_world(config.terrain), config.area);
}

void report(const ReportOptions& options) {
  MissionRecord record = read_mission(options.log);
  record.buildings = buildings(options.config);
  write_page(record, options.out);
  for (const std::string& remark : remarks(record))
    fmt::print(stderr, "comptonaut: {}: {}\n", options.log.string(), remark);
  fmt::print("{}\n\n{}\nReport: {}\n", headline(record, score(record)), source_list(record), options.out.string());
}

}  // namespace

void add_report_command(CLI::App& app) {
  const auto options = std::make_shared<ReportOptions>();
  CLI::App* command = app.add_subcommand("report", "Makes one HTML page of an lcm-logger recording of a mission");
  command->add_option("log", options->log, "Recording of the ground bus")->required();
  command->add_option("--out", options->out, "Page to write")->capture_default_str();
  command->add_option("--config", options->config,
                      "The coordinator's: buildings of its terrain are drawn into the map");
  command->callback([options] { report(*options); });
}

}  // namespace comptonaut
