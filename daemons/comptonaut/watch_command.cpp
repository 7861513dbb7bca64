// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <memory>

#include "bus/bus.h"
#include "bus/daemon.h"
#include "commands.h"
#include "nodes/mission_watch.h"

namespace comptonaut {
namespace {

/// One line that is written over on a terminal; elsewhere a line for every ten seconds of the mission.
void watch(const std::string& lcm_url) {
  const bool terminal = isatty(STDOUT_FILENO) == 1;
  std::int64_t shown_s = -10;
  MissionWatch mission;
  const auto show = [&](bool last) {
    if (terminal) fmt::print("\r{}\033[K{}", mission.line(), last ? "\n" : "");
    if (!terminal && (last || mission.elapsed_s() >= shown_s + 10)) fmt::print("{}\n", mission.line());
    if (mission.elapsed_s() >= shown_s + 10) shown_s = mission.elapsed_s();
    std::fflush(stdout);
  };

  Bus bus(lcm_url);
  bus.subscribe<MeasurementBatch>("MAV.*_MEASUREMENTS",
                                  [&](const auto&, const auto& batch) { mission.on_measurements(batch); });
  bus.subscribe<SourceReport>("SOURCES", [&](const auto&, const auto& report) { mission.on_sources(report); });
  bus.subscribe<Truth>("SIM_TRUTH", [&](const auto&, const auto& truth) { mission.on_truth(truth); });
  EventLoop loop;
  loop.watch(bus);
  loop.every(std::chrono::milliseconds(200), [&] { show(false); });
  loop.run();
  show(true);
}

}  // namespace

void add_watch_command(CLI::App& app) {
  const auto lcm_url = std::make_shared<std::string>("udpm://239.255.76.67:7667?ttl=0");
  CLI::App* command = app.add_subcommand("watch", "Shows in one line how the mission on a bus goes, until Ctrl-C");
  command->add_option("--lcm-url", *lcm_url, "Bus of the machine that leads")->capture_default_str();
  command->callback([lcm_url] { watch(*lcm_url); });
}

}  // namespace comptonaut
