// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/sim_camera.h"

namespace comptonaut {

/// A camera that looks down, on a chip whose pixels are all alike.
inline SimCamera test_camera() {
  const SensorConfig sensor;
  return {.channel = {},
          .lines = {{"Cs-137", emitted_lines({})}},
          .transport = Transport(sensor_block(sensor), load_cdte()),
          .digitizer = Digitizer({}, sensor, Calibration::uniform()),
          .X_BD = Eigen::Translation3d(0, 0, -0.05) * Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX())};
}

}  // namespace comptonaut
