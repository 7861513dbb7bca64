// SPDX-License-Identifier: BSD-3-Clause
#include "flight/grid_search.h"

#include <algorithm>
#include <compare>
#include <cstdint>
#include <limits>
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

class Search {
 public:
  explicit Search(const GridProblem& problem) : problem_(problem) {
    nodes_.push_back({.p_W = problem.goal_W, .grid = {}});
    nodes_.push_back({.p_W = problem.start_W, .grid = {}, .cost_m = 0.0});
    index_[{}] = kStart;
    open_.push({(problem.goal_W - problem.start_W).norm(), kStart});
  }

  std::optional<std::vector<Eigen::Vector3d>> run() {
    for (std::size_t expanded = 0; !open_.empty() && expanded < problem_.expanded_max;) {
      const std::size_t at = open_.top().node;
      open_.pop();
      if (at == kGoal) return path();
      if (nodes_[at].done) continue;
      nodes_[at].done = true;
      ++expanded;
      expand(at);
    }
    return std::nullopt;
  }

 private:
  static constexpr std::size_t kGoal = 0, kStart = 1;

  struct Node {
    Eigen::Vector3d p_W;
    GridPoint grid;
    double cost_m = std::numeric_limits<double>::infinity();
    std::size_t from = kStart;
    bool done = false;
  };
  struct Entry {
    double estimate_m;
    std::size_t node;
    // The queue gives the greatest: smallest estimate, then smallest index.
    bool operator<(const Entry& other) const {
      return estimate_m != other.estimate_m ? estimate_m > other.estimate_m : node > other.node;
    }
  };

  void expand(std::size_t at) {
    if ((nodes_[at].p_W - problem_.goal_W).norm() < kGoalReach * problem_.step_m) relax(at, kGoal);
    const GridPoint grid = nodes_[at].grid;
    for (int dz = -1; dz <= 1; ++dz) {
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          if (dx != 0 || dy != 0 || dz != 0) relax(at, node_at({grid.x + dx, grid.y + dy, grid.z + dz}));
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

  void relax(std::size_t from, std::size_t to) {
    const Leg leg{.from_W = nodes_[from].p_W, .to_W = nodes_[to].p_W};
    const double cost_m = nodes_[from].cost_m + (leg.to_W - leg.from_W).norm();
    if (nodes_[to].done || cost_m >= nodes_[to].cost_m || !problem_.clear(leg)) return;
    nodes_[to].cost_m = cost_m;
    nodes_[to].from = from;
    open_.push({cost_m + (leg.to_W - problem_.goal_W).norm(), to});
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
