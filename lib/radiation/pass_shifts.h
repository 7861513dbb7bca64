// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "radiation/joint_model.h"

namespace comptonaut {

/// What errors of the poses add to the covariance of each source's x and y, m^2: the pose of a drone is off by
/// pass_sigma_m, per axis, anew each pass_s. A shift d of the detector during one pass pulls a source by C I_pass d,
/// I_pass being what that pass tells about the source's place (Fisher information) and C the place's covariance from
/// all data:
///   sum over passes of pass_sigma_m^2 (C I_pass) (C I_pass)^T
/// `covariances` holds C, m^2, of each source of the state.
[[nodiscard]] std::vector<Eigen::Matrix2d> pass_shifts(const JointProblem& problem, const JointState& state,
                                                       const std::vector<Eigen::Matrix2d>& covariances);

}  // namespace comptonaut
