// SPDX-License-Identifier: BSD-3-Clause
#include "sim/sim_camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "config/config.h"

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

DetectorReaderConfig load_detector_reader_config(const std::filesystem::path& file) {
  return load_config(file, [](Config& config) {
    (void)config.has("input");
    return read_detector_reader_config(config);
  });
}

SimCamera sim_camera(const DetectorReaderConfig& reader, const MapperConfig& mapper, const std::string& nuclide) {
  const SensorConfig& sensor = reader.rules.sensor;
  return {.channel = channel_of(reader, nuclide),
          .transport = Transport(sensor_block(sensor), load_cdte()),
          .digitizer = Digitizer({}, sensor, load_calibration(reader)),
          .X_BD = mapper.X_BD};
}

}  // namespace comptonaut
