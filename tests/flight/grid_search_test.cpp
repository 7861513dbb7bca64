// SPDX-License-Identifier: BSD-3-Clause
#include "flight/grid_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "core/random.h"

namespace comptonaut {
namespace {

using Point = std::tuple<int, int, int>;

struct Maze {
  int size = 6;
  double step_m = 0.5;
  std::set<Point> blocked;
  Eigen::Vector3d start_W{1.0, 2.0, 3.0};

  [[nodiscard]] Eigen::Vector3d p_W(const Point& at) const {
    return start_W + step_m * Eigen::Vector3d(std::get<0>(at), std::get<1>(at), std::get<2>(at));
  }
  [[nodiscard]] Point nearest(const Eigen::Vector3d& p) const {
    const Eigen::Vector3d g = (p - start_W) / step_m;
    return {static_cast<int>(std::lround(g.x())), static_cast<int>(std::lround(g.y())),
            static_cast<int>(std::lround(g.z()))};
  }
  [[nodiscard]] bool open(const Point& at) const {
    const auto [x, y, z] = at;
    return x >= 0 && y >= 0 && z >= 0 && x < size && y < size && z < size && !blocked.contains(at);
  }
};

/// Length of the shortest path by relaxing every edge until nothing changes: slow, with no heuristic and no queue.
double slow_shortest(const Maze& maze, const Eigen::Vector3d& goal_W) {
  std::map<Point, double> cost;
  cost[{0, 0, 0}] = 0.0;
  for (bool changed = true; changed;) {
    changed = false;
    const auto before = cost;
    for (const auto& [at, c] : before) {
      const auto [x, y, z] = at;
      for (int n = 0; n < 27; ++n) {
        const Point next{x + n % 3 - 1, y + n / 3 % 3 - 1, z + n / 9 - 1};
        if (!maze.open(next)) continue;
        const double through = c + (maze.p_W(next) - maze.p_W(at)).norm();
        const auto it = cost.find(next);
        if (it != cost.end() && it->second <= through + 1e-12) continue;
        cost[next] = through;
        changed = true;
      }
    }
  }
  double best = std::numeric_limits<double>::infinity();
  for (const auto& [at, c] : cost) {
    const double rest = (maze.p_W(at) - goal_W).norm();
    if (rest < kGoalReach * maze.step_m) best = std::min(best, c + rest);
  }
  return best;
}

double length(const std::vector<Eigen::Vector3d>& path) {
  double sum = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) sum += (path[i] - path[i - 1]).norm();
  return sum;
}

TEST(GridSearch, FindsPathsAsShortAsTheSlowSearch) {
  Random random(1);
  int found = 0, none = 0;
  for (int run = 0; run < 60; ++run) {
    Maze maze;
    const double density = random.uniform(0.3, 0.95);
    for (int n = 1; n < maze.size * maze.size * maze.size; ++n) {
      const Point at{n % maze.size, n / maze.size % maze.size, n / maze.size / maze.size};
      if (random.uniform() < density) maze.blocked.insert(at);
    }
    const Eigen::Vector3d goal_W =
        maze.start_W + Eigen::Vector3d(random.uniform(0, 2.5), random.uniform(0, 2.5), random.uniform(0, 2.5));
    // Legs between grid points are clear where both ends are open; those to the goal always.
    const auto clear = [&](const Leg& leg) { return leg.to_W == goal_W || maze.open(maze.nearest(leg.to_W)); };
    const auto path = shortest_grid_path({maze.start_W, goal_W, maze.step_m, clear, 100000}).path;
    const double expected = slow_shortest(maze, goal_W);
    ASSERT_EQ(path.has_value(), std::isfinite(expected)) << "run " << run;
    if (!path) {
      ++none;
      continue;
    }
    ++found;
    EXPECT_EQ(path->front(), maze.start_W) << "run " << run;
    EXPECT_EQ(path->back(), goal_W) << "run " << run;
    EXPECT_NEAR(length(*path), expected, 1e-9) << "run " << run;
  }
  EXPECT_GT(found, 20);
  EXPECT_GT(none, 5);
}

/// Blocks all points so many steps from the middle: a room of two times as many less one.
void wall_in(Maze& maze, const Point& middle, int steps) {
  const auto [x, y, z] = middle;
  for (int dx = -steps; dx <= steps; ++dx) {
    for (int dy = -steps; dy <= steps; ++dy) {
      for (int dz = -steps; dz <= steps; ++dz) {
        const Point at{x + dx, y + dy, z + dz};
        if (std::max({std::abs(dx), std::abs(dy), std::abs(dz)}) == steps && at != Point{}) maze.blocked.insert(at);
      }
    }
  }
}

TEST(GridSearch, LookingFromTheGoalTooChangesNoAnswerAndIsQuickWhereThatIsWalledIn) {
  Random random(2);
  int found = 0, quick = 0;
  for (int run = 0; run < 60; ++run) {
    Maze maze{.size = 24, .step_m = 0.5};
    const double density = random.uniform(0.5, 0.9);
    for (int n = 1; n < maze.size * maze.size * maze.size; ++n) {
      const Point at{n % maze.size, n / maze.size % maze.size, n / maze.size / maze.size};
      if (random.uniform() < density) maze.blocked.insert(at);
    }
    const double far_m = maze.step_m * (maze.size - 1);
    const Eigen::Vector3d goal_W =
        maze.start_W + Eigen::Vector3d(random.uniform(0, far_m), random.uniform(0, far_m), random.uniform(0, far_m));
    if (run % 2 == 0) wall_in(maze, maze.nearest(goal_W), 4);
    long asked = 0;
    const auto open = [&](const Eigen::Vector3d& p_W) { return p_W == goal_W || maze.open(maze.nearest(p_W)); };
    const auto clear = [&](const Leg& leg) { return ++asked, open(leg.from_W) && open(leg.to_W); };
    GridProblem problem{maze.start_W, goal_W, maze.step_m, clear};
    const auto one_way = shortest_grid_path(problem).path;
    const long asked_one_way = std::exchange(asked, 0);
    problem.both_ways = true;
    const GridAnswer answer = shortest_grid_path(problem);
    const long asked_both_ways = asked;
    ASSERT_EQ(answer.path, one_way) << "run " << run;
    for (const Eigen::Vector3d& p_W : answer.pocket_W) {
      problem.goal_W = p_W;
      problem.both_ways = false;
      ASSERT_FALSE(answer.path || shortest_grid_path(problem).path) << "run " << run;
      if (&p_W - answer.pocket_W.data() > 3) break;  // slow
    }
    if (one_way) ++found;
    if (!one_way && asked_both_ways < asked_one_way / 2) ++quick;
  }
  EXPECT_GT(found, 10);
  EXPECT_GT(quick, 10);
}

TEST(GridSearch, GivesUpAfterSoManyPoints) {
  const auto clear = [](const Leg& leg) { return leg.to_W.x() < 5.0; };  // endless, with the goal behind a wall
  EXPECT_FALSE(shortest_grid_path({{0, 0, 0}, {10, 0, 0}, 1.0, clear, 2000}).path);
}

}  // namespace
}  // namespace comptonaut
