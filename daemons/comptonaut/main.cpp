// SPDX-License-Identifier: BSD-3-Clause
// `comptonaut`, the command for people.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "commands.h"

int main(int argc, char** argv) {
  CLI::App app("Finds gamma-ray sources with a team of small drones.", "comptonaut");
  app.set_version_flag("--version", COMPTONAUT_VERSION);
  app.require_subcommand(1);
  comptonaut::add_campaign_command(app);
  comptonaut::add_detect_command(app);
  comptonaut::add_reconstruct_command(app);
  comptonaut::add_report_command(app);
  comptonaut::add_response_command(app);
  comptonaut::add_scenario_command(app);
  comptonaut::add_spectrum_command(app);
  comptonaut::add_town_command(app);
  comptonaut::add_watch_command(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help_or_version) {
    return app.exit(help_or_version);
  } catch (const CLI::ParseError& error) {
    const std::string said = argc > 1 && app.get_subcommands().empty() ? fmt::format("'{}': ", argv[1]) : "";
    fmt::print(stderr, "comptonaut: {}{} (see --help)\n", said, error.what());
    return 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "comptonaut: %s\n", error.what());
    return 1;
  }
  return 0;
}
