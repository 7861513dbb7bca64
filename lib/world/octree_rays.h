// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/OcTree.h>

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "world/box_tree.h"

namespace comptonaut {

/// The leaves that are occupied, or those that are free, as rays need them; nullptr: there are none.
[[nodiscard]] std::unique_ptr<BoxTree> boxes_for_rays(const octomap::OcTree& tree, bool occupied);

/// Along a direction to the first occupied voxel, m, to a tenth of a millimetre; unknown space lets rays through.
/// nullopt: further than max_m.
[[nodiscard]] std::optional<double> range_m(const octomap::OcTree& tree, const Eigen::Vector3d& p_W,
                                            const Eigen::Vector3d& direction_W, double max_m);

}  // namespace comptonaut
