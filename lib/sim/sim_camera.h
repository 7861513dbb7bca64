// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include "detector/nuclide.h"
#include "physics/transport.h"
#include "response/digitizer.h"

namespace comptonaut {

/// What all simulated cameras have in common. Immutable, may be shared among threads.
struct SimCamera {
  NuclideChannel channel;  ///< the line that sources send out
  Transport transport;
  Digitizer digitizer;     ///< each camera works with a copy of its own
  Eigen::Isometry3d X_BD;  ///< mount as the mapper believes it to be
};

}  // namespace comptonaut
