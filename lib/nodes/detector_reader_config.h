// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>

#include "detector/events.h"
#include "detector/hit_stream.h"
#include "detector/hot_pixels.h"

namespace comptonaut {

class Config;

struct DetectorReaderConfig {
  std::int64_t mission = 1;
  EventRules rules;
  HitStreamConfig stream;
  HotPixelConfig hot_pixels;
  std::filesystem::path calibration;  ///< folder with a.txt b.txt c.txt t.txt; empty: a typical chip's for all pixels
};

/// `nuclides` is a list of files with one channel each. Throws ConfigError.
[[nodiscard]] DetectorReaderConfig read_detector_reader_config(Config& config);

/// The calibration that the configuration names. Throws std::runtime_error that names file and line.
[[nodiscard]] Calibration load_calibration(const DetectorReaderConfig& config);

}  // namespace comptonaut
