// SPDX-License-Identifier: BSD-3-Clause
#include "sim/sim_camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "config/config.h"

namespace comptonaut {
namespace {

NuclideChannel channel_of(const DetectorReaderConfig& reader, const std::string& nuclide) {
  const auto& channels = reader.rules.channels;
  const auto found = std::find_if(channels.begin(), channels.end(),
                                  [&](const NuclideChannel& channel) { return channel.name == nuclide; });
  if (found != channels.end()) return *found;
  throw std::runtime_error(
      fmt::format("the detector-reader has no channel for {}: name its file in nuclides", nuclide));
}

}  // namespace

DetectorReaderConfig load_detector_reader_config(const std::filesystem::path& file) {
  return load_config(file, [](Config& config) {
    (void)config.has("input");
    return read_detector_reader_config(config);
  });
}

SimCamera sim_camera(const DetectorReaderConfig& reader, const MapperConfig& mapper, const Scenario& scenario) {
  const SensorConfig& sensor = reader.rules.sensor;
  Lines lines = {{scenario.nuclide, emitted_lines(channel_of(reader, scenario.nuclide))}};
  for (const std::string& nuclide : scenario.more_nuclides) lines[nuclide] = emitted_lines(channel_of(reader, nuclide));
  return {.channel = channel_of(reader, scenario.nuclide),
          .lines = std::move(lines),
          .transport = Transport(sensor_block(sensor), load_cdte()),
          .digitizer = Digitizer({}, sensor, load_calibration(reader)),
          .obstacles = scenario.world.is_flat() ? std::nullopt : std::optional(Shield::load(scenario.material)),
          .X_BD = mapper.X_BD};
}

}  // namespace comptonaut
