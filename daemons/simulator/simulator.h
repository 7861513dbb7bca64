// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "bus/daemon.h"
#include "links.h"
#include "sim/pace.h"
#include "sim/sim_world.h"
#include "sim/simulator_config.h"

namespace comptonaut {

/// Where the daemons of MAV n listen: base + n.
struct SimulatorPorts {
  int detector = 0;   ///< TCP, detector-readers
  int autopilot = 0;  ///< UDP, pose-bridges
  int bus = 0;        ///< LCM, mappers, otherwise as the simulator's bus; 0: on that
};

/// Carries the simulated world's bytes to the daemons of all drones and theirs back, as fast as the coordinator's
/// ticks come and the detector-readers read. Waits for all daemons first and ends the loop with the tick of the
/// horizon.
class Simulator {
 public:
  /// All references must outlive this.
  Simulator(const SimulatorConfig& config, const Scenario& scenario, std::uint64_t seed, const SimCamera& camera,
            SimulatorPorts ports, const DaemonArguments& arguments, EventLoop& loop, Bus& bus);

  [[nodiscard]] DaemonStatus status() const;

 private:
  struct Mav {
    TcpLink detector;
    UdpLink autopilot;
    std::unique_ptr<Bus> bus;  ///< its own; nullptr: the simulator's
    bool heard = false;        ///< from its pose bridge: at all, then since the last step that waits for answers
  };
  struct Counts {
    std::int64_t steps = 0, datagrams_in = 0, datagrams_out = 0, hit_bytes = 0, hit_bytes_lost = 0, reconnects = 0,
                 answers_missed = 0;
  };

  [[nodiscard]] double now_s() const { return monotonic_s(arguments_); }
  void connect();
  void begin_mission();
  void receive(int mav);
  void advance();
  [[nodiscard]] bool readers_keep_up();
  [[nodiscard]] bool answered();
  void step();
  void send_hits(int mav, const std::string& text);
  void publish_truth();
  void check_patience() const;

  const SimulatorConfig& config_;
  const Scenario& scenario_;
  std::uint64_t seed_;
  const SimCamera& camera_;
  const DaemonArguments& arguments_;
  EventLoop& loop_;
  Bus& bus_;
  std::vector<Mav> mavs_;
  std::optional<SimWorld> world_;
  std::optional<Pace> pace_;
  double start_s_;       ///< monotonic, of waiting, then of the mission
  double last_tick_s_;   ///< monotonic
  double last_chunk_s_;  ///< monotonic
  double last_truth_s_;  ///< monotonic
  Counts counts_;
};

}  // namespace comptonaut
