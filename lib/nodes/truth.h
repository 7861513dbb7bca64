// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "core/cells.h"
#include "core/time.h"

namespace comptonaut {

struct TrueSource {
  std::string nuclide;
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  ///< m
  double activity_Bq = 0.0;
};

struct TrueMav {
  std::int32_t mav = 0;
  Eigen::Vector3d p_WB = Eigen::Vector3d::Zero();  ///< m
  double yaw_rad = 0.0;
  std::int64_t photons = 0;  ///< that interacted in its detector so far
};

/// What the simulator knows and nobody else may use: for the report and for tests.
struct Truth {
  Utime utime = 0;
  Utime start_utime = 0;  ///< of the mission
  std::string scenario;
  double time_scale = 1.0;  ///< simulated seconds per second of the clock on the wall
  Area area;
  std::vector<TrueSource> sources;
  std::vector<TrueMav> mavs;
};

}  // namespace comptonaut
