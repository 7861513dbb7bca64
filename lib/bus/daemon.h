// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bus/bus.h"
#include "nodes/status.h"

namespace comptonaut {

/// One thread's loop over file descriptors, timers and the signals that end a daemon.
class EventLoop {
 public:
  EventLoop();
  ~EventLoop();
  EventLoop(const EventLoop&) = delete;
  EventLoop& operator=(const EventLoop&) = delete;

  void watch(int fd, std::function<void()> on_readable);
  void unwatch(int fd);
  /// Handles everything that has arrived on the bus each time that it is readable, then does what is to be done once
  /// all of it is known.
  void watch(Bus& bus, const std::function<void()>& then = nullptr);
  void every(std::chrono::milliseconds period, std::function<void()> action);
  /// Until SIGTERM, SIGINT or stop(). Then what has arrived on watched descriptors is still handled, once.
  void run();
  void stop();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// What every daemon is told on its command line.
struct DaemonArguments {
  std::filesystem::path config;
  std::string lcm_url = "udpm://239.255.76.67:7667?ttl=0";
  int mav = 0;              ///< --mav N: this machine's number; 0 is the ground station
  double time_scale = 1.0;  ///< --time-scale X: liveness runs X times as fast, for simulations faster than real time
};

/// One more option of one daemon, for example {"--input", "file:PATH, tcp:PORT or -", &input}; one without a value,
/// for example {.name = "--follow", .help = "never lead", .flag = &follow}.
struct ExtraOption {
  std::string name;
  std::string help;
  std::string* value = nullptr;
  bool* flag = nullptr;
};

/// Runs a daemon: reads the command line (--config, --lcm-url, --mav, --time-scale, --help, --version), calls `body`,
/// returns its exit code: 0 after a signal, 1 with one clear line on stderr after an exception.
int run_daemon(int argc, char** argv, const std::string& name, const std::string& purpose,
               const std::vector<ExtraOption>& extra, const std::function<void(const DaemonArguments&)>& body);

/// One line on stderr; with the journal's prefix for a warning where no person reads it.
void print_warning(const std::string& daemon, const std::string& message);

/// Seconds on the monotonic clock, times the daemon's time scale: for liveness only.
[[nodiscard]] double monotonic_s(const DaemonArguments& arguments);

/// Now on the wall clock, for boot epochs and log lines only.
[[nodiscard]] Utime wall_clock_utime();

/// Publishes MAVn_STATUS once a second from now on; fills in sender, daemon, version and the bus's own counters.
void publish_status(EventLoop& loop, Bus& bus, const DaemonArguments& arguments, const std::string& daemon,
                    std::function<DaemonStatus()> status);

}  // namespace comptonaut
