// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "radiation/joint_fit.h"
#include "radiation/joint_model.h"
#include "radiation/source_estimate.h"

namespace comptonaut {

/// A disc of even activity that explains the data in the place of several point sources.
struct SourceDisc {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();
  double radius_m = 0.0;
  double activity_Bq = 0.0;
  double gain = 0.0;                 ///< its log likelihood less that of the points
  std::vector<std::size_t> members;  ///< the points, index into the state's sources
};

/// Where points do not explain the data: three or more of a state's point sources, each within kLink_m of another, that
/// cost more than they tell. One disc (place, radius, activity) in their place, everything else fitted, loses less than
/// gain_to_add per point that it saves, one and a half points being its own cost: then activity is spread there.
/// `before`: discs of the last time, from which the search goes on by one step of each parameter.
[[nodiscard]] std::vector<SourceDisc> discs_of(const JointProblem& problem, const Ground& ground,
                                               const JointState& state, std::span<const SourceDisc> before);

/// What a disc of 1 Bq gives: the mean of the columns of points that fill it evenly, on the ground.
[[nodiscard]] ResponseColumn disc_column(const JointProblem& problem, const Ground& ground, const Eigen::Vector3d& p_W,
                                         double radius_m);

/// The state without the members of the discs: what the map has not to show.
[[nodiscard]] JointState without_members(const JointProblem& problem, const JointState& state,
                                         std::span<const SourceDisc> discs);

/// The discs as patches, strongest first.
[[nodiscard]] std::vector<PatchEstimate> patches_of(std::span<const SourceDisc> discs, const std::string& nuclide);

}  // namespace comptonaut
