// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "radiation/joint_model.h"

namespace comptonaut {

/// Log likelihood that is lost without source k, with all else as it is, counting only what a map of obstacles that is
/// wrong by a voxel cannot feign: at the edge of the shadow that an obstacle throws from a strong source, more or less
/// of it shines through than is expected, and a weak source at the obstacle's foot explains that as well.
[[nodiscard]] double sure_loss(const JointProblem& problem, const JointState& state, std::size_t k);

}  // namespace comptonaut
