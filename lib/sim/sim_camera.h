// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <optional>
#include <string>

#include "detector/nuclide.h"
#include "nodes/detector_reader_config.h"
#include "nodes/mapper_config.h"
#include "physics/shield.h"
#include "physics/transport.h"
#include "response/digitizer.h"
#include "sim/emitters.h"
#include "sim/scenario.h"

namespace comptonaut {

/// What all simulated cameras have in common. Immutable, may be shared among threads.
struct SimCamera {
  NuclideChannel channel;  ///< of the scenario's first nuclide
  Lines lines;             ///< what sources send out
  Transport transport;
  Digitizer digitizer;              ///< each camera works with a copy of its own
  std::optional<Shield> obstacles;  ///< what they are made of; nullopt: there are none
  Eigen::Isometry3d X_BD;           ///< mount as the mapper believes it to be
};

/// What a detector-reader's file says of its node; its `input` section is the daemon's own. Throws ConfigError.
[[nodiscard]] DetectorReaderConfig load_detector_reader_config(const std::filesystem::path& file);

/// The camera that a detector-reader and a mapper are configured for, and what the scenario's nuclides send out. Throws
/// std::runtime_error where the reader does not know a nuclide or its calibration cannot be read.
[[nodiscard]] SimCamera sim_camera(const DetectorReaderConfig& reader, const MapperConfig& mapper,
                                   const Scenario& scenario);

}  // namespace comptonaut
