// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "radiation/ground_tree.h"
#include "radiation/node_field.h"
#include "radiation/response_column.h"
#include "radiation/view.h"

namespace comptonaut {

/// Points of the ground that stand for nodes: a cell by its centre, merged cells by `per_axis` points along x times as
/// many along y, Gauss's for an even square with the cells' standard deviations (of two, one from the middle). Means
/// over cells are exact up to third powers.
struct NodePoints {
  /// per_axis: 2 or 3.
  NodePoints(const GroundTree& tree, std::span<const std::uint32_t> nodes, int per_axis);

  int per_axis;
  std::size_t merged = 0, single = 0;        ///< nodes of several points, then of one
  std::vector<double> sigma_x_m, sigma_y_m;  ///< of the merged ones
  CellCentres points;
};

/// L exp(-mu d) / d^2 over nodes, fitted to three points per axis: within 0.1 % of it, rms, where a node is not wider
/// than a fifth of its distance.
struct NodeResponse {
  std::vector<NodeField> single, pair;
};
[[nodiscard]] NodeResponse node_response(const JointPhysics& physics, const NodePoints& nodes, const Eye& eye);

/// Means over nodes of t_i of one pair: pair_density at each point, two per axis.
[[nodiscard]] std::vector<double> node_density(const JointPhysics& physics, const NodePoints& nodes, const Pair& pair);

}  // namespace comptonaut
