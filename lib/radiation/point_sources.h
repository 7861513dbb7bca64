// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "radiation/joint_fit.h"
#include "radiation/joint_model.h"
#include "radiation/score_map.h"

namespace comptonaut {

/// Improves a set of point sources on new data (design, section 5.4b), a conditional-gradient method over measures on
/// the ground with non-convex moves [Boyd, Schiebinger, Recht 2017; Denoyelle et al. 2019]:
///   fit    all activities, positions and nuisances together;
///   lift   sources whose height above the surface the data demand (source_heights.h);
///   add    where the score pulls: several of its maxima, each with a re-fit, of which the best stays if it gains
///          config.gain_to_add;
///   drop   what costs less than config.loss_to_drop when it is taken out and the others re-fitted, or merged into its
///          neighbour; what costs less than config.loss_to_reseed is also looked for elsewhere.
///   split  one source, by `turn`, into two where the score pulls to both sides of it, if that gains enough.
///   separate  a known source that the data have moved from what is believed of it, and one of the channel's own beside
///          it that does so instead, if that gains enough.
/// Deterministic. `map` must have been extended to the data.
void improve(const JointProblem& problem, const Ground& ground, const ScoreMap& map, std::size_t turn,
             JointState& state);

/// The best state with one more source that the score's maxima lead to, nullopt where none gains anything.
[[nodiscard]] std::optional<JointState> with_best_addition(const JointProblem& problem, const Ground& ground,
                                                           const ScoreMap& map, const JointState& state);

}  // namespace comptonaut
