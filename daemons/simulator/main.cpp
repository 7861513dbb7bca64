// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <charconv>
#include <stdexcept>

#include "bus/daemon.h"
#include "config/config.h"
#include "sim/sim_camera.h"
#include "simulator.h"

using namespace comptonaut;

namespace {

template <class T>
T whole_number(const std::string& option, const std::string& text, T max) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc() && end == text.data() + text.size() && value >= 0 && value <= max) return value;
  throw std::runtime_error(fmt::format("{} '{}': must be a whole number from 0 to {}", option, text, max));
}

}  // namespace

int main(int argc, char** argv) {
  std::string scenario_file, seed = "1", detector_port = "7720", autopilot_port = "7730", bus_port = "0";
  const std::vector<ExtraOption> options = {
      {"--scenario", "what to fly, YAML", &scenario_file},
      {"--seed", "of sources and noise (1)", &seed},
      {"--detector-port", "the detector-reader of MAV n listens on this TCP port + n (7720)", &detector_port},
      {"--autopilot-port", "the pose-bridge of MAV n listens on this UDP port + n (7730)", &autopilot_port},
      {"--bus-port", "the mapper of MAV n listens at --lcm-url with this port + n (0: with its own)", &bus_port}};
  return run_daemon(argc, argv, "comptonaut-simulator", "Stands in for the hardware of all drones.", options,
                    [&](const DaemonArguments& arguments) {
                      if (scenario_file.empty()) throw std::runtime_error("--scenario FILE is missing");
                      const auto config = load_config(arguments.config, read_simulator_config);
                      const Scenario scenario = load_scenario(scenario_file);
                      const auto reader = load_detector_reader_config(config.detector_reader);
                      const auto mapper = load_config(config.mapper, read_mapper_config);
                      const SimCamera camera = sim_camera(reader, mapper, scenario);
                      const SimulatorPorts ports{.detector = whole_number("--detector-port", detector_port, 65'000),
                                                 .autopilot = whole_number("--autopilot-port", autopilot_port, 65'000),
                                                 .bus = whole_number("--bus-port", bus_port, 65'000)};
                      EventLoop loop;
                      Bus bus(arguments.lcm_url);
                      Simulator simulator(config, scenario, whole_number<std::uint64_t>("--seed", seed, 1'000'000'000),
                                          camera, ports, arguments, loop, bus);
                      loop.watch(bus);
                      publish_status(loop, bus, arguments, "simulator", [&] { return simulator.status(); });
                      loop.run();
                    });
}
