// SPDX-License-Identifier: BSD-3-Clause
#include "detector_options.h"

#include <stdexcept>

#include "config/config.h"

namespace comptonaut {

void add_detector_options(CLI::App& command, DetectorOptions& options) {
  command.add_option("--calibration", options.calibration, "Folder with the chip's a.txt b.txt c.txt t.txt");
  command.add_option("--config", options.config,
                     "The detector as in config/detector-reader.yaml: sensor, calibration, windows, hot pixels");
}

DetectorReaderConfig detector_of(const DetectorOptions& options) {
  DetectorReaderConfig config;
  if (!options.config.empty()) config = load_config(options.config, read_detector_reader_config);
  if (!options.calibration.empty()) config.calibration = options.calibration;
  if (config.calibration.empty()) {
    throw std::runtime_error("--calibration: the folder with the chip's a.txt b.txt c.txt t.txt is missing");
  }
  return config;
}

}  // namespace comptonaut
