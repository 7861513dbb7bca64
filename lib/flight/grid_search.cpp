// SPDX-License-Identifier: BSD-3-Clause
#include "flight/grid_search.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstdint>
#include <numbers>
#include <queue>
#include <unordered_map>

namespace comptonaut {
namespace {

struct GridPoint {
  std::int32_t x = 0, y = 0, z = 0;
  auto operator<=>(const GridPoint&) const = default;
};

struct GridPointHash {
  std::size_t operator()(const GridPoint& p) const {
    const auto part = [](std::int32_t value) { return static_cast<std::uint64_t>(value) & 0x1FFFFF; };
    std::uint64_t bits = part(p.x) | part(p.y) << 21 | part(p.z) << 42;
    bits *= 0x9E3779B97F4A7C15;
    return bits ^ bits >> 32;
  }
};

/// Length of the shortest way over the grid's 26 directions, and a bit, by `away_m`.
double over_grid_m(const Eigen::Vector3d& away_m) {
  Eigen::Vector3d a = away_m.cwiseAbs();
  std::sort(a.begin(), a.end());
  return std::numbers::sqrt3 * a[0] + std::numbers::sqrt2 * (a[1] - a[0]) + (a[2] - a[1]);
}

/// A leg is looked at only when it would be the next to be flown [lazy A*: Cohen, Phillips, Likhachev 2015]: looking is
/// what costs.
class Search {
 public:
  explicit Search(const GridProblem& problem) : problem_(problem) {
    nodes_.push_back({.p_W = problem.goal_W, .grid = {}});
    nodes_.push_back({.p_W = problem.start_W, .grid = {}});
    index_[{}] = kStart;
    open_.push({.estimate_m = least_m(problem.start_W), .cost_m = 0.0, .node = kStart, .from = kStart});
  }

  std::optional<std::vector<Eigen::Vector3d>> run() {
    for (std::size_t expanded = 0; !open_.empty() && expanded < problem_.expanded_max;) {
      const Entry next = open_.top();
      open_.pop();
      Node& node = nodes_[next.node];
      const bool begins = next.node == kStart;
      if (node.done || !(begins || problem_.clear({nodes_[next.from].p_W, node.p_W}))) continue;
      node.done = true;
      node.from = next.from;
      if (next.node == kGoal) return path();
      ++expanded;
      expand(next.node, next.cost_m);
    }
    return std::nullopt;
  }

 private:
  static constexpr std::size_t kGoal = 0, kStart = 1;

  struct Node {
    Eigen::Vector3d p_W;
    GridPoint grid;
    std::size_t from = kStart;
    bool done = false;
  };
  /// A way to a node, its last leg not looked at yet.
  struct Entry {
    double estimate_m;  ///< of the whole way to the goal
    double cost_m;      ///< of it, to the node
    std::size_t node, from;
    // The queue gives the greatest: smallest estimate, then nearest to the goal, then smallest index.
    bool operator<(const Entry& other) const {
      if (estimate_m != other.estimate_m) return estimate_m > other.estimate_m;
      return cost_m != other.cost_m ? cost_m < other.cost_m : node > other.node;
    }
  };

  /// No way to the goal is shorter: over the grid to some point near the goal, and straight on.
  [[nodiscard]] double least_m(const Eigen::Vector3d& p_W) const {
    constexpr double kGridExcess = 0.129;  // over_grid_m is at most so much longer than the straight line
    const Eigen::Vector3d away_m = problem_.goal_W - p_W;
    return std::max(away_m.norm(), over_grid_m(away_m) - kGridExcess * kGoalReach * problem_.step_m);
  }

  void expand(std::size_t at, double cost_m) {
    const Node node = nodes_[at];
    const double left_m = (problem_.goal_W - node.p_W).norm();
    if (left_m < kGoalReach * problem_.step_m) push(kGoal, at, cost_m + left_m);
    for (int dz = -1; dz <= 1; ++dz) {
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const int steps2 = dx * dx + dy * dy + dz * dz;
          if (steps2 == 0) continue;
          const std::size_t to = node_at({node.grid.x + dx, node.grid.y + dy, node.grid.z + dz});
          push(to, at, cost_m + problem_.step_m * std::sqrt(steps2));
        }
      }
    }
  }

  std::size_t node_at(const GridPoint& grid) {
    const auto [it, is_new] = index_.try_emplace(grid, nodes_.size());
    if (is_new) {
      const Eigen::Vector3d p_W = problem_.start_W + problem_.step_m * Eigen::Vector3d(grid.x, grid.y, grid.z);
      nodes_.push_back({.p_W = p_W, .grid = grid});
    }
    return it->second;
  }

  void push(std::size_t node, std::size_t from, double cost_m) {
    if (nodes_[node].done) return;
    open_.push({.estimate_m = cost_m + least_m(nodes_[node].p_W), .cost_m = cost_m, .node = node, .from = from});
  }

  [[nodiscard]] std::vector<Eigen::Vector3d> path() const {
    std::vector<Eigen::Vector3d> points;
    for (std::size_t at = kGoal; at != kStart; at = nodes_[at].from) points.push_back(nodes_[at].p_W);
    points.push_back(problem_.start_W);
    std::ranges::reverse(points);
    return points;
  }

  const GridProblem& problem_;
  std::vector<Node> nodes_;
  std::unordered_map<GridPoint, std::size_t, GridPointHash> index_;
  std::priority_queue<Entry> open_;
};

}  // namespace

std::optional<std::vector<Eigen::Vector3d>> shortest_grid_path(const GridProblem& problem) {
  return Search(problem).run();
}

}  // namespace comptonaut
