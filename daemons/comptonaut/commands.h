// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace CLI {
class App;
}

namespace comptonaut {

/// Each adds one subcommand with its options; CLI11 calls it while it parses. A failure is an exception.
void add_campaign_command(CLI::App& app);
void add_detect_command(CLI::App& app);
void add_reconstruct_command(CLI::App& app);
void add_report_command(CLI::App& app);
void add_response_command(CLI::App& app);
void add_scenario_command(CLI::App& app);
void add_spectrum_command(CLI::App& app);
void add_town_command(CLI::App& app);
void add_watch_command(CLI::App& app);

}  // namespace comptonaut
