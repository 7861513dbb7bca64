// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "radiation/joint_config.h"
#include "radiation/response_column.h"

namespace comptonaut {

/// The channel of one nuclide as the joint likelihood sees it. Of several, by rising line, each one's
/// physics.of_others are the nuclides of the channels after it.
struct JointChannel {
  std::string nuclide;
  JointConfig config;
  JointPhysics physics;
};

}  // namespace comptonaut
