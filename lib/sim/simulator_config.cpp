// SPDX-License-Identifier: BSD-3-Clause
#include "sim/simulator_config.h"

#include "config/config.h"

namespace comptonaut {

SimulatorConfig read_simulator_config(Config& config) {
  SimulatorConfig simulator;
  config.require("detector_reader", simulator.detector_reader);
  config.require("mapper", simulator.mapper);
  config.read("start_utime_s", simulator.start_utime_s, {.min = 0.0, .max = 1e11});
  config.read("connect_timeout_s", simulator.connect_timeout_s, {.min = 1.0, .max = 3600.0});
  config.read("stall_timeout_s", simulator.stall_timeout_s, {.min = 1.0, .max = 3600.0});
  config.read("answer_wait_s", simulator.answer_wait_s, {.min = 0.0, .max = 1.0});
  config.read("lead_s", simulator.pace.lead_s, {.min = 0.0, .max = 60.0});
  config.read("startup_s", simulator.pace.startup_s, {.min = 1.5, .max = 60.0});
  config.read("time_scale_max", simulator.pace.time_scale_max, {.min = 0.0, .max = 1000.0});
  return simulator;
}

}  // namespace comptonaut
