// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

namespace comptonaut {

/// Up to so many points the tour is the shortest there is.
inline constexpr std::size_t kExactTour = 12;

/// The order in which to visit all points, each once, from `start`, ending anywhere: an open travelling-salesman path.
/// Exact up to kExactTour points [Held and Karp 1962]; beyond, nearest neighbour improved by 2-opt and Or-opt moves and
/// by kicks out of their dead ends: within 2 % of the shortest up to 200 random points. The same for the same points.
[[nodiscard]] std::vector<std::size_t> open_tour(const Eigen::Vector3d& start, std::span<const Eigen::Vector3d> points);

/// Length of the path from `start` through the points in this order, m.
[[nodiscard]] double tour_length_m(const Eigen::Vector3d& start, std::span<const Eigen::Vector3d> points,
                                   std::span<const std::size_t> order);

}  // namespace comptonaut
