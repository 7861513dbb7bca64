// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "radiation/measurement_batch.h"

namespace comptonaut {

/// What detectors measured, each batch once, in the order in which a coordinator folds: by time, MAV and number.
struct RecordedMeasurements {
  std::vector<MeasurementBatch> batches;
  std::vector<std::string> remarks;  ///< what of the recording was left out, a line each
};

/// The MAVn_MEASUREMENTS of an lcm-logger recording. Throws std::runtime_error, one line that names the file, where it
/// cannot be read, holds none, or none of the nuclide.
[[nodiscard]] RecordedMeasurements read_measurements(const std::filesystem::path& log, const std::string& nuclide);

/// The same of the two CSV files (see measurement_csv.h), viewpoints first, in the order of the rows. Throws
/// std::runtime_error where a row is wrong, there is no viewpoint, or a drone has cones without any live time.
[[nodiscard]] RecordedMeasurements read_measurements(const std::filesystem::path& cones,
                                                     const std::filesystem::path& viewpoints,
                                                     const std::string& nuclide);

}  // namespace comptonaut
