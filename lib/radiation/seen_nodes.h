// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "radiation/ground_tree.h"
#include "radiation/response_column.h"
#include "radiation/view.h"

namespace comptonaut {

/// Points of the ground whose mean stands for nodes: a cell by its centre, merged cells by four points, one standard
/// deviation from their mean along x and y, which is exact up to third powers.
struct NodePoints {
  NodePoints(const GroundTree& tree, std::span<const std::uint32_t> nodes);

  std::size_t merged = 0, single = 0;  ///< nodes of four points, then of one
  CellCentres points;
};

/// Means over nodes of L exp(-mu d) / d^2.
struct NodeResponse {
  std::vector<double> single, pair;
};
[[nodiscard]] NodeResponse node_response(const JointPhysics& physics, const NodePoints& nodes, const Eye& eye);

/// Means over nodes of t_i of one pair: pair_density at each point.
[[nodiscard]] std::vector<double> node_density(const JointPhysics& physics, const NodePoints& nodes, const Pair& pair);

}  // namespace comptonaut
