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

/// Reads all files and fits the team to the scenario. Throws ConfigError or std::runtime_error that names the file.
[[nodiscard]] MissionSetup load_setup(const MissionFiles& files);

}  // namespace comptonaut
