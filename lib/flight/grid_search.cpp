// SPDX-License-Identifier: BSD-3-Clause
#include "flight/grid_search.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstdint>
#include <numbers>
#include <queue>
#include <unordered_map>
#include <utility>

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

  GridAnswer run() {
    for (std::size_t expanded = 0; !open_.empty() && expanded < problem_.expanded_max;) {
      const Entry next = open_.top();
      open_.pop();
      Node& node = nodes_[next.node];
      const bool begins = next.node == kStart;
      if (node.done || !(begins || problem_.clear({nodes_[next.from].p_W, node.p_W}))) continue;
      node.done = true;
      node.from = next.from;
      if (next.node == kGoal) return {.path = path(), .pocket_W = {}};
      if (node.pocket) pocket_is_open_ = true;
      expand(next.node, next.cost_m);
      if (++expanded == kTakesLong) begin_pocket();
      if (expanded >= kTakesLong && !pocket_is_open_ && !grow_pocket()) return {.path = {}, .pocket_W = pocket()};
    }
    return {};
  }

 private:
  static constexpr std::size_t kGoal = 0, kStart = 1;
  static constexpr std::size_t kTakesLong = 300;

  struct Node {
    Eigen::Vector3d p_W;
    GridPoint grid;
    std::size_t from = kStart;
    bool done = false;
    bool pocket = false;
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
    for_each_neighbour(node.grid, 1, [&](const GridPoint& grid, int steps2) {
      push(node_at(grid), at, cost_m + problem_.step_m * std::sqrt(steps2));
    });
  }

  template <typename Visit>
  static void for_each_neighbour(const GridPoint& grid, int steps, const Visit& visit) {
    for (int dz = -steps; dz <= steps; ++dz) {
      for (int dy = -steps; dy <= steps; ++dy) {
        for (int dx = -steps; dx <= steps; ++dx) {
          const int steps2 = dx * dx + dy * dy + dz * dz;
          if (steps2 > 0) visit(GridPoint{grid.x + dx, grid.y + dy, grid.z + dz}, steps2);
        }
      }
    }
  }

  /// The pocket: the points from which one gets to the goal, as far as they are known. It is open once it holds one to
  /// which the way from the start is known, and that is when there is a way.
  void begin_pocket() {
    pocket_is_open_ = !problem_.both_ways;
    if (pocket_is_open_) return;
    const Eigen::Vector3d goal = ((problem_.goal_W - problem_.start_W) / problem_.step_m).array().round();
    const auto whole = [](double x) { return static_cast<std::int32_t>(x); };
    const GridPoint nearest{whole(goal.x()), whole(goal.y()), whole(goal.z())};
    const auto visit = [&](const GridPoint& grid, int) {
      const std::size_t at = node_at(grid);
      const Eigen::Vector3d p_W = nodes_[at].p_W;
      const bool reaches = (problem_.goal_W - p_W).norm() < kGoalReach * problem_.step_m;
      if (reaches && problem_.clear({p_W, problem_.goal_W})) add_to_pocket(at);
    };
    visit(nearest, 0);
    for_each_neighbour(nearest, 2, visit);
  }

  void add_to_pocket(std::size_t node) {
    if (std::exchange(nodes_[node].pocket, true)) return;
    pocket_border_.push_back(node);
    if (nodes_[node].done) pocket_is_open_ = true;
  }

  /// By the neighbours of one of its points; false: there is nothing more that it could grow by.
  bool grow_pocket() {
    if (pocket_border_.empty()) return false;
    const Node node = nodes_[pocket_border_.back()];
    pocket_border_.pop_back();
    for_each_neighbour(node.grid, 1, [&](const GridPoint& grid, int) {
      const std::size_t to = node_at(grid);
      if (!nodes_[to].pocket && problem_.clear({node.p_W, nodes_[to].p_W})) add_to_pocket(to);
    });
    return true;
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

  [[nodiscard]] std::vector<Eigen::Vector3d> pocket() const {
    std::vector<Eigen::Vector3d> points;
    for (const Node& node : nodes_) {
      if (node.pocket) points.push_back(node.p_W);
    }
    return points;
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
  std::vector<std::size_t> pocket_border_;
  bool pocket_is_open_ = false;
};

}  // namespace

GridAnswer shortest_grid_path(const GridProblem& problem) { return Search(problem).run(); }

}  // namespace comptonaut
