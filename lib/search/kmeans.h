// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

namespace comptonaut {

/// Points of the horizontal plane in clusters.
struct Clusters {
  std::vector<Eigen::Vector2d> centres;
  std::vector<std::size_t> cluster_of;  ///< per point
};

/// Lloyd's K-means from given centres, at most `iterations` rounds. No cluster stays empty while there are as many
/// points as clusters: an empty one takes the point that lies farthest from its centre. Ties go to the lower index.
[[nodiscard]] Clusters kmeans(std::span<const Eigen::Vector2d> points, std::vector<Eigen::Vector2d> seeds,
                              int iterations = 20);

/// `k` of the points, spread out: the one nearest to their mean, then always the one farthest from those taken
/// [Gonzalez 1985]. All points where there are no more than k.
[[nodiscard]] std::vector<Eigen::Vector2d> spread_seeds(std::span<const Eigen::Vector2d> points, std::size_t k);

}  // namespace comptonaut
