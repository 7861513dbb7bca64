// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>

#include "nodes/detector_reader_config.h"

namespace comptonaut {

/// Which detector made a recording.
struct DetectorOptions {
  std::filesystem::path config;       ///< as detector-reader's; empty: a MiniPIX TPX3 with 2 mm CdTe at -450 V
  std::filesystem::path calibration;  ///< instead of the configuration's
};

/// --config and --calibration.
void add_detector_options(CLI::App& command, DetectorOptions& options);

/// What --config says, or what is usual, with the calibration that was given besides. Throws std::runtime_error where
/// neither names a calibration.
[[nodiscard]] DetectorReaderConfig detector_of(const DetectorOptions& options);

}  // namespace comptonaut
