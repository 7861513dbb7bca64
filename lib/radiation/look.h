// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace comptonaut {

/// What a detector counted at one place, 50 ms or so, beside what was to be expected there.
struct Look {
  Eigen::Vector3d p_WD = Eigen::Vector3d::Zero();
  double live_s = 0.0;
  double singles = 0.0;     ///< counted
  double expected = 0.0;    ///< of background and of the sources that are known now
  double background = 0.0;  ///< the former's part of it
};

}  // namespace comptonaut
