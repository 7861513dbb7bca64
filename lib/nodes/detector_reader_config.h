// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "detector/events.h"
#include "detector/hit_stream.h"
#include "detector/hot_pixels.h"

namespace comptonaut {

class Config;

/// Where the daemon gets hits from.
struct InputConfig {
  std::string bind_address = "127.0.0.1";  ///< that tcp:PORT listens at
  double speed = 1.0;                      ///< of a file: seconds of the recording per second
};

struct DetectorReaderConfig {
  std::int64_t mission = 1;
  EventRules rules;
  HitStreamConfig stream;
  HotPixelConfig hot_pixels;
  std::filesystem::path calibration;  ///< folder with a.txt b.txt c.txt t.txt; empty: a typical chip's for all pixels
  InputConfig input;
};

/// `nuclides` is a list of files with one channel each. Throws ConfigError.
[[nodiscard]] DetectorReaderConfig read_detector_reader_config(Config& config);

/// The calibration that the configuration names. Throws std::runtime_error that names file and line.
[[nodiscard]] Calibration load_calibration(const DetectorReaderConfig& config);

}  // namespace comptonaut
