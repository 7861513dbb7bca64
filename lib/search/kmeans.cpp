// SPDX-License-Identifier: BSD-3-Clause
#include "search/kmeans.h"

#include <algorithm>
#include <limits>

namespace comptonaut {
namespace {

using PlanePoints = std::span<const Eigen::Vector2d>;

std::size_t nearest(PlanePoints centres, const Eigen::Vector2d& p) {
  std::size_t best = 0;
  double best_m2 = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < centres.size(); ++c) {
    const double m2 = (centres[c] - p).squaredNorm();
    if (m2 < best_m2) best = c, best_m2 = m2;
  }
  return best;
}

/// Gives each empty cluster the point that lies farthest from the centre of a cluster with more than one point.
void fill_empty(PlanePoints points, Clusters& clusters) {
  std::vector<std::size_t> sizes(clusters.centres.size(), 0);
  for (const std::size_t c : clusters.cluster_of) ++sizes[c];
  for (std::size_t c = 0; c < sizes.size(); ++c) {
    if (sizes[c] > 0) continue;
    std::size_t farthest = points.size();
    double farthest_m2 = -1.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const std::size_t owner = clusters.cluster_of[i];
      const double m2 = (points[i] - clusters.centres[owner]).squaredNorm();
      if (sizes[owner] > 1 && m2 > farthest_m2) farthest = i, farthest_m2 = m2;
    }
    if (farthest == points.size()) return;  // fewer points than clusters
    --sizes[clusters.cluster_of[farthest]];
    sizes[c] = 1;
    clusters.cluster_of[farthest] = c;
  }
}

/// Whether any centre moved.
bool move_centres(PlanePoints points, Clusters& clusters) {
  std::vector<Eigen::Vector2d> sums(clusters.centres.size(), Eigen::Vector2d::Zero());
  std::vector<double> sizes(clusters.centres.size(), 0.0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    sums[clusters.cluster_of[i]] += points[i];
    sizes[clusters.cluster_of[i]] += 1.0;
  }
  bool moved = false;
  for (std::size_t c = 0; c < sums.size(); ++c) {
    if (sizes[c] == 0.0) continue;
    const Eigen::Vector2d mean = sums[c] / sizes[c];
    moved = moved || mean != clusters.centres[c];
    clusters.centres[c] = mean;
  }
  return moved;
}

}  // namespace

Clusters kmeans(PlanePoints points, std::vector<Eigen::Vector2d> seeds, int iterations) {
  Clusters clusters{.centres = std::move(seeds), .cluster_of = std::vector<std::size_t>(points.size(), 0)};
  if (clusters.centres.empty()) return clusters;
  for (int i = 0; i < iterations; ++i) {
    for (std::size_t p = 0; p < points.size(); ++p) clusters.cluster_of[p] = nearest(clusters.centres, points[p]);
    fill_empty(points, clusters);
    if (!move_centres(points, clusters)) break;
  }
  return clusters;
}

std::vector<Eigen::Vector2d> spread_seeds(PlanePoints points, std::size_t k) {
  if (points.size() <= k) return {points.begin(), points.end()};
  std::vector<Eigen::Vector2d> seeds;
  if (k == 0) return seeds;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& p : points) mean += p / static_cast<double>(points.size());
  seeds.push_back(points[nearest(points, mean)]);
  std::vector<double> distance_m2(points.size(), std::numeric_limits<double>::infinity());
  while (seeds.size() < k) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      distance_m2[i] = std::min(distance_m2[i], (points[i] - seeds.back()).squaredNorm());
    }
    const auto farthest = std::max_element(distance_m2.begin(), distance_m2.end());
    seeds.push_back(points[static_cast<std::size_t>(farthest - distance_m2.begin())]);
  }
  return seeds;
}

}  // namespace comptonaut
