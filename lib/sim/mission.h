// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <stop_token>
#include <vector>

#include "detector/calibration.h"
#include "nodes/coordinator_config.h"
#include "nodes/detector_reader.h"
#include "nodes/mapper.h"
#include "nodes/more_nuclides.h"
#include "nodes/pose_bridge.h"
#include "response/cone_density.h"
#include "response/response_table.h"
#include "sim/mission_result.h"
#include "sim/scenario.h"
#include "sim/sim_camera.h"

namespace comptonaut {

/// A team as it is configured to fly: the same for each seed, shared among threads.
struct MissionSetup {
  Scenario scenario;
  SimCamera camera;
  Calibration calibration;  ///< of all chips
  ResponseTable response;
  std::optional<ConeDensity> cones;  ///< what the estimator "joint" needs
  std::vector<MoreNuclide> more_nuclides = {};
  DetectorReaderConfig detector_reader;
  PoseBridgeConfig pose_bridge;
  MapperConfig mapper;
  CoordinatorConfig coordinator;
  std::uint64_t fingerprint = 0;  ///< of the files and the world that it was made of
};

/// Flies one mission: the simulated world on the hardware's wires, and the nodes of all daemons in one thread, each
/// message through the encoding that it has on the bus. The same result for the same seed, but for cpu_s.
/// Counts simulated seconds in `seconds_done`. Throws std::logic_error where a node stops working, std::runtime_error
/// when it is stopped.
[[nodiscard]] MissionResult fly_mission(const MissionSetup& setup, std::uint64_t seed,
                                        std::atomic<std::int64_t>& seconds_done, const std::stop_token& stop = {});

}  // namespace comptonaut
