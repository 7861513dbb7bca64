// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>

#include "sim/pace.h"

namespace comptonaut {

class Config;

struct SimulatorConfig {
  std::filesystem::path detector_reader;  ///< its configuration: the simulated chips are what the readers believe
  std::filesystem::path mapper;           ///< likewise, for the mount of the cameras
  std::int64_t start_utime_s = 0;         ///< UTC of the mission's start; 0: now
  double connect_timeout_s = 60.0;        ///< for all daemons to be there
  double stall_timeout_s = 60.0;          ///< without a tick of the coordinator
  double answer_wait_s = 0.005;           ///< for each pose bridge's setpoint, after every 50 ms of simulated time
  PaceConfig pace;
};

[[nodiscard]] SimulatorConfig read_simulator_config(Config& config);

}  // namespace comptonaut
