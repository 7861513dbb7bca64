// SPDX-License-Identifier: BSD-3-Clause
#include "bus/daemon.h"

#include <fmt/core.h>
#include <pthread.h>
#include <signal.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>

#include "bus/valid.h"

namespace comptonaut {
namespace {

constexpr std::size_t kStatusMax_bytes = 1100;  // a datagram of the team bus less its trailer

/// SIGTERM and SIGINT wait for the EventLoop, also in the threads of LCM; a closed pipe is an error of write().
void prepare_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  signal(SIGPIPE, SIG_IGN);
}

/// One line on stderr; with the journal's prefix for its priority where no person reads it.
void print_line(const char* priority, const std::string& name, std::string message) {
  std::replace(message.begin(), message.end(), '\n', ' ');
  fmt::print(stderr, "{}{}: {}\n", isatty(STDERR_FILENO) != 0 ? "" : priority, name, message);
}

void print_error(const std::string& name, const std::string& message) { print_line("<3>", name, message); }

void add_options(CLI::App& app, DaemonArguments& arguments, const std::vector<ExtraOption>& extra) {
  app.add_option("--config", arguments.config, "YAML configuration file")->required()->type_name("FILE");
  app.add_option("--lcm-url", arguments.lcm_url, "onboard bus")->type_name("URL")->capture_default_str();
  app.add_option("--mav", arguments.mav, "number of this MAV, 0 for the ground station")
      ->check(CLI::Range(0, kMaxMav))
      ->type_name("N")
      ->capture_default_str();
  app.add_option("--time-scale", arguments.time_scale, "liveness runs so many times as fast as the clock")
      ->check(CLI::Range(1e-3, 1e3))
      ->type_name("X")
      ->capture_default_str();
  for (const ExtraOption& option : extra) {
    if (option.value != nullptr) app.add_option(option.name, *option.value, option.help)->capture_default_str();
    if (option.flag != nullptr) app.add_flag(option.name, *option.flag, option.help);
  }
}

/// A status per part of its counters, so that each fits a datagram.
std::vector<DaemonStatus> in_datagrams(DaemonStatus whole) {
  std::vector<DaemonStatus> parts;
  const std::vector<Counter> counters = std::move(whole.counters);
  whole.counters.clear();
  const std::size_t head_bytes = encode(whole).size();
  std::size_t bytes = kStatusMax_bytes + 1;
  for (const Counter& counter : counters) {
    const std::size_t counter_bytes = std::min(counter.name.size(), kMaxText) + 4 + 1 + 8;
    if (bytes + counter_bytes > kStatusMax_bytes) {
      parts.push_back(whole);
      bytes = head_bytes;
    }
    parts.back().counters.push_back(counter);
    bytes += counter_bytes;
  }
  if (parts.empty()) parts.push_back(whole);
  return parts;
}

}  // namespace

int run_daemon(int argc, char** argv, const std::string& name, const std::string& purpose,
               const std::vector<ExtraOption>& extra, const std::function<void(const DaemonArguments&)>& body) {
  DaemonArguments arguments;
  CLI::App app(purpose, name);
  app.set_version_flag("--version", name + " " + COMPTONAUT_VERSION);
  add_options(app, arguments, extra);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help_or_version) {
    return app.exit(help_or_version);
  } catch (const CLI::ParseError& e) {
    print_error(name, std::string(e.what()) + " (see --help)");
    return 1;
  }
  try {
    prepare_signals();
    body(arguments);
    return 0;
  } catch (const std::exception& e) {
    print_error(name, e.what());
    return 1;
  }
}

void print_warning(const std::string& daemon, const std::string& message) { print_line("<4>", daemon, message); }

double monotonic_s(const DaemonArguments& arguments) {
  const std::chrono::duration<double> now = std::chrono::steady_clock::now().time_since_epoch();
  return arguments.time_scale * now.count();
}

Utime wall_clock_utime() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::microseconds>(now).count();
}

void publish_status(EventLoop& loop, Bus& bus, const DaemonArguments& arguments, const std::string& daemon,
                    std::function<DaemonStatus()> status) {
  const auto period = std::chrono::milliseconds(std::max(1L, std::lround(1000.0 / arguments.time_scale)));
  loop.every(period, [&bus, mav = arguments.mav, daemon, status = std::move(status)] {
    DaemonStatus now = status();
    now.sender = mav;
    now.daemon = daemon;
    now.version = COMPTONAUT_VERSION;
    for (Counter& counter : bus.counters()) now.counters.push_back(std::move(counter));
    for (const DaemonStatus& part : in_datagrams(std::move(now))) bus.publish(mav_channel(mav, "STATUS"), part);
  });
}

}  // namespace comptonaut
