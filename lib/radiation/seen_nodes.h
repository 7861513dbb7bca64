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
  /// per_axis: 2 or 3. `nodes`: merged ones come first.
  NodePoints(const GroundTree& tree, std::span<const std::uint32_t> nodes, int per_axis);

  std::size_t merged = 0, single = 0;        ///< nodes of several points, then of one
  std::vector<double> sigma_x_m, sigma_y_m;  ///< of the merged ones
  CellCentres points;                        ///< the first of all merged nodes, the second of all, ...; the single ones
};

/// Sums over eyes of live_s L exp(-mu d) / d^2, of each point, s.
struct PointSums {
  explicit PointSums(const NodePoints& nodes) : single(nodes.points.size, 0.0), pair(nodes.points.size, 0.0) {}
  void add(const JointPhysics& physics, const NodePoints& nodes, const Eye& eye, double live_s);

  std::vector<double> single, pair;
};

/// Functions over nodes fitted to values at three points per axis: L exp(-mu d) / d^2 within 0.1 %, rms, where a node
/// is not wider than a fifth of its distance.
[[nodiscard]] std::vector<NodeField> fitted(const NodePoints& nodes, const std::vector<double>& values);

/// Means over nodes of t_i of one pair: pair_density at each point, two per axis.
[[nodiscard]] std::vector<double> node_density(const JointPhysics& physics, const NodePoints& nodes, const Pair& pair);

}  // namespace comptonaut
