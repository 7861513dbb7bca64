// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "sim/mission.h"

namespace comptonaut {

/// What a mission is made of.
struct MissionFiles {
  std::filesystem::path scenario;
  std::filesystem::path coordinator = "config/coordinator.yaml";  ///< the drones' daemons' files stand in its folder
};

/// The camera that a detector-reader and a mapper are configured for. Throws std::runtime_error where the reader does
/// not know the nuclide or its calibration cannot be read.
[[nodiscard]] SimCamera sim_camera(const DetectorReaderConfig& reader, const MapperConfig& mapper,
                                   const std::string& nuclide);

/// Reads all files and fits the team to the scenario. Throws ConfigError or std::runtime_error that names the file.
[[nodiscard]] MissionSetup load_setup(const MissionFiles& files);

}  // namespace comptonaut
