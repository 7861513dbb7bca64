// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiation/joint_fit.h"
#include "radiation/joint_model.h"

namespace comptonaut {

/// Lifts sources off the surface where the data demand it, and puts back those that no longer need it: a source stands
/// on the surface unless its height gains config.gain_to_lift in log likelihood, all else re-fitted. Between that and
/// kLiftMargin less a lifted one stays. Activity and height look much alike from afar; only passes near by tell them
/// apart. True: something changed.
bool adjust_heights(const JointProblem& problem, const Ground& ground, JointState& state);

}  // namespace comptonaut
