// SPDX-License-Identifier: BSD-3-Clause
#include "sim/load_setup.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "config/config.h"
#include "sim/fit.h"

namespace comptonaut {
namespace {

NuclideChannel channel_of(const DetectorReaderConfig& reader, const std::string& nuclide) {
  const auto& channels = reader.rules.channels;
  const auto found = std::find_if(channels.begin(), channels.end(),
                                  [&](const NuclideChannel& channel) { return channel.name == nuclide; });
  if (found != channels.end()) return *found;
  throw std::runtime_error(fmt::format("the detector-reader has no channel for {}", nuclide));
}

}  // namespace

SimCamera sim_camera(const DetectorReaderConfig& reader, const MapperConfig& mapper, const std::string& nuclide) {
  const SensorConfig& sensor = reader.rules.sensor;
  return {.channel = channel_of(reader, nuclide),
          .transport = Transport(sensor_block(sensor), load_cdte()),
          .digitizer = Digitizer({}, sensor, load_calibration(reader)),
          .X_BD = mapper.X_BD};
}

MissionSetup load_setup(const MissionFiles& files) {
  const std::filesystem::path folder = files.coordinator.parent_path();
  const Scenario scenario = load_scenario(files.scenario);
  const auto reader = load_config(folder / "detector-reader.yaml", read_detector_reader_config);
  const auto mapper = load_config(folder / "mapper.yaml", read_mapper_config);
  auto bridge = load_config(folder / "pose-bridge.yaml", read_pose_bridge_config);
  auto coordinator = load_config(files.coordinator, read_coordinator_config);
  fit_to(scenario, coordinator);
  return {.scenario = scenario,
          .camera = sim_camera(reader, mapper, scenario.nuclide),
          .calibration = load_calibration(reader),
          .response = ResponseTable::load(coordinator.response_table),
          .detector_reader = reader,
          .pose_bridge = bridge,
          .mapper = mapper,
          .coordinator = coordinator};
}

}  // namespace comptonaut
