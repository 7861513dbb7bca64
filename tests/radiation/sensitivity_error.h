// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "radiation/joint_map.h"

namespace comptonaut {

/// Relative, over cells drawn at random.
struct SensitivityError {
  double rms = 0.0, worst = 0.0;
};

/// A map's sensitivity against each cell's own sum over all viewpoints.
inline SensitivityError sensitivity_error(const JointMap& map, const Cells& ground, const JointPhysics& physics,
                                          const JointData& data, const JointModel& model) {
  const std::vector<double> fast = map.sensitivity_s();
  Random random(51);
  SensitivityError error;
  constexpr int kCells = 500;
  ResponseColumn column;
  for (int i = 0; i < kCells; ++i) {
    const auto j = static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(ground.size())));
    fill_column(physics, data, ground.p_W(j), column);
    double slow = 0.0;
    for (std::size_t d = 0; d < model.drones.size(); ++d) slow += model.drones[d].scale * column.exposure_s[d];
    for (std::size_t v = 0; v < data.viewpoints.size(); ++v) {
      slow += model.drones[data.viewpoints.drone[v]].scale * model.scatter * column.singles[v];
    }
    const double off = std::abs(fast[j] / slow - 1.0);
    error.rms += off * off / kCells;
    error.worst = std::max(error.worst, off);
  }
  error.rms = std::sqrt(error.rms);
  return error;
}

}  // namespace comptonaut
