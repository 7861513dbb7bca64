// SPDX-License-Identifier: BSD-3-Clause
#include "flight/trajectory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/random.h"

namespace comptonaut {
namespace {

struct Flight {
  Motion start;
  std::vector<Waypoint> waypoints;
  MotionLimits limits;

  [[nodiscard]] Trajectory trajectory() const { return {start.p_W, start.v_W, waypoints, limits}; }
};

Eigen::Vector3d draw(Random& random, double half) {
  return {random.uniform(-half, half), random.uniform(-half, half), random.uniform(-half, half)};
}

Flight random_flight(Random& random, double start_speed_m_s) {
  Flight flight;
  flight.limits = {random.uniform(1, 10), random.uniform(1, 6), random.uniform(0.05, 1)};
  flight.start.p_W = draw(random, 20);
  flight.start.v_W = start_speed_m_s * random.unit_vector();
  const auto n = random() % 8;
  for (std::size_t i = 0; i < n; ++i) {
    const bool close = random.uniform() < 0.2;
    const Eigen::Vector3d from = i == 0 ? flight.start.p_W : flight.waypoints.back().p_W;
    flight.waypoints.push_back({from + draw(random, close ? 0.05 : 20), random.uniform(-1, 12), 0});
    if (random.uniform() < 0.1) flight.waypoints.push_back(flight.waypoints.back());             // twice
    if (random.uniform() < 0.1) flight.waypoints.push_back({from, random.uniform(0.5, 12), 0});  // straight back
  }
  return flight;
}

double distance_from_leg(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const double length2 = (b - a).squaredNorm();
  const double f = length2 > 0 ? std::clamp((p - a).dot(b - a) / length2, 0.0, 1.0) : 0.0;
  return (p - a - f * (b - a)).norm();
}

double distance_from_way(const Eigen::Vector3d& p_W, const Flight& flight) {
  double nearest = std::numeric_limits<double>::infinity();
  Eigen::Vector3d from = flight.start.p_W;
  for (const Waypoint& to : flight.waypoints) {
    nearest = std::min(nearest, distance_from_leg(p_W, from, to.p_W));
    from = to.p_W;
  }
  return nearest;
}

constexpr double kStep_s = 0.004;

TEST(Trajectory, NeverExceedsTheAccelerationAndIsSmooth) {
  Random random(1);
  for (int run = 0; run < 300; ++run) {
    const Flight flight = random_flight(random, run % 2 == 0 ? 0.0 : random.uniform(0, 12));
    const Trajectory trajectory = flight.trajectory();
    const double a_max = flight.limits.acceleration_max_m_s2 * (1 + 1e-9);
    Motion before = trajectory.sample(0);
    EXPECT_LT((before.p_W - flight.start.p_W).norm(), 1e-9) << "run " << run;
    EXPECT_LT((before.v_W - flight.start.v_W).norm(), 1e-6) << "run " << run;
    for (double t = kStep_s; t < trajectory.duration_s() + 1; t += kStep_s) {
      const Motion now = trajectory.sample(t);
      ASSERT_LE(now.a_W.norm(), a_max) << "run " << run << " at " << t;
      ASSERT_LE((now.v_W - before.v_W).norm(), a_max * kStep_s + 1e-6) << "run " << run << " at " << t;
      const Eigen::Vector3d moved = now.p_W - before.p_W - 0.5 * kStep_s * (now.v_W + before.v_W);
      ASSERT_LE(moved.norm(), 0.5 * a_max * kStep_s * kStep_s + 1e-6) << "run " << run << " at " << t;
      before = now;
    }
  }
}

TEST(Trajectory, KeepsEachLegsSpeedLimit) {
  Random random(2);
  for (int run = 0; run < 300; ++run) {
    const Flight flight = random_flight(random, 0.0);
    const Trajectory trajectory = flight.trajectory();
    for (double t = 0; t < trajectory.duration_s(); t += kStep_s) {
      const std::size_t to = trajectory.waypoint_at(t);
      ASSERT_LT(to, flight.waypoints.size()) << "run " << run << " at " << t;
      const double leg_limit = flight.waypoints[to].speed_max_m_s;
      const double limit =
          leg_limit > 0 ? std::min(leg_limit, flight.limits.speed_max_m_s) : flight.limits.speed_max_m_s;
      ASSERT_LE(trajectory.sample(t).v_W.norm(), limit * (1 + 1e-9)) << "run " << run << " at " << t;
    }
  }
}

TEST(Trajectory, GoesNoFasterThanTheLimitOrItsStart) {
  Random random(3);
  for (int run = 0; run < 300; ++run) {
    const Flight flight = random_flight(random, random.uniform(0, 12));
    const Trajectory trajectory = flight.trajectory();
    const double limit = std::max(flight.limits.speed_max_m_s, flight.start.v_W.norm()) * (1 + 1e-9);
    for (double t = 0; t < trajectory.duration_s(); t += kStep_s) {
      ASSERT_LE(trajectory.sample(t).v_W.norm(), limit) << "run " << run << " at " << t;
    }
  }
}

TEST(Trajectory, StaysOnTheWayButForCutCorners) {
  Random random(4);
  for (int run = 0; run < 300; ++run) {
    const Flight flight = random_flight(random, 0.0);
    if (flight.waypoints.empty()) continue;
    const Trajectory trajectory = flight.trajectory();
    for (double t = 0; t < trajectory.duration_s(); t += kStep_s) {
      ASSERT_LE(distance_from_way(trajectory.sample(t).p_W, flight), flight.limits.corner_deviation_max_m + 1e-6)
          << "run " << run << " at " << t;
    }
  }
}

TEST(Trajectory, LeavesTheWayOnlyAboutAMovingStart) {
  Random random(5);
  for (int run = 0; run < 300; ++run) {
    const Flight flight = random_flight(random, random.uniform(0, 12));
    if (flight.waypoints.empty()) continue;
    const Trajectory trajectory = flight.trajectory();
    const double reach =
        2 * flight.start.v_W.squaredNorm() / flight.limits.acceleration_max_m_s2 + flight.limits.corner_deviation_max_m;
    double visited = 0.0;
    for (double t = 0; t < trajectory.duration_s(); t += kStep_s) {
      const Eigen::Vector3d p_W = trajectory.sample(t).p_W;
      const double off = distance_from_way(p_W, flight);
      ASSERT_LE(off, reach + 1e-6) << "run " << run << " at " << t;
      if (trajectory.waypoint_at(t) > 1) visited = std::max(visited, off);
    }
    ASSERT_LE(visited, flight.limits.corner_deviation_max_m + 1e-6) << "run " << run;
  }
}

TEST(Trajectory, PassesEachWaypointInOrderAndEndsAtRestOnTheLast) {
  Random random(6);
  for (int run = 0; run < 300; ++run) {
    const Flight flight = random_flight(random, run % 2 == 0 ? 0.0 : random.uniform(0, 12));
    const Trajectory trajectory = flight.trajectory();
    const Motion end = trajectory.sample(trajectory.duration_s() + 0.1);
    EXPECT_EQ(end.v_W.norm(), 0.0) << "run " << run;
    EXPECT_EQ(trajectory.waypoint_at(trajectory.duration_s() + 0.1), flight.waypoints.size()) << "run " << run;
    if (flight.waypoints.empty()) continue;
    EXPECT_LT((end.p_W - flight.waypoints.back().p_W).norm(), 1e-6) << "run " << run;
    std::vector<double> nearest(flight.waypoints.size(), std::numeric_limits<double>::infinity());
    std::size_t at = 0;
    for (double t = 0; t < trajectory.duration_s() + kStep_s; t += kStep_s) {
      EXPECT_GE(trajectory.waypoint_at(t), at) << "run " << run << " at " << t;
      at = trajectory.waypoint_at(t);
      for (std::size_t i = 0; i < nearest.size(); ++i) {
        nearest[i] = std::min(nearest[i], (trajectory.sample(t).p_W - flight.waypoints[i].p_W).norm());
      }
    }
    // Sampling may miss the nearest point by half a step.
    const double tolerance = flight.limits.corner_deviation_max_m + kStep_s * flight.limits.speed_max_m_s;
    for (std::size_t i = 0; i < nearest.size(); ++i) EXPECT_LE(nearest[i], tolerance) << "run " << run << ": " << i;
  }
}

TEST(Trajectory, TakesTheTimeThatATrapezoidTakes) {
  const MotionLimits limits{8.0, 4.0, 0.25};
  const std::vector<Waypoint> far{{{50, 0, 2}, 8, 0}}, near{{{4, 0, 2}, 8, 0}};
  EXPECT_NEAR(Trajectory({0, 0, 2}, {0, 0, 0}, far, limits).duration_s(), 50 / 8.0 + 8 / 4.0, 1e-9);
  EXPECT_NEAR(Trajectory({0, 0, 2}, {0, 0, 0}, near, limits).duration_s(), 2 * std::sqrt(4 / 4.0), 1e-9);
  EXPECT_NEAR(Trajectory({0, 0, 2}, {8, 0, 0}, far, limits).duration_s(), 50 / 8.0 + 8 / 8.0, 1e-9);
}

TEST(Trajectory, BrakesToAStopWithoutWaypoints) {
  const Trajectory brake({0, 0, 2}, {6, 0, 0}, {}, {8.0, 4.0, 0.25});
  EXPECT_NEAR(brake.duration_s(), 1.5, 1e-12);
  EXPECT_NEAR(brake.sample(9).p_W.x(), 4.5, 1e-12);
  EXPECT_EQ(Trajectory({1, 2, 3}).sample(5).p_W, Eigen::Vector3d(1, 2, 3));
}

TEST(Trajectory, ContinuesAsBeforeWhenPlannedAnewOnTheWay) {
  const MotionLimits limits{8.0, 4.0, 0.25};
  const std::vector<Waypoint> waypoints{{{30, 0, 2}, 8, 0}, {{30, 20, 2}, 8, 0}};
  const Trajectory first({0, 0, 2}, {0, 0, 0}, waypoints, limits);
  for (const double t : {0.5, 1.0, 2.5}) {
    const Motion now = first.sample(t);
    const Trajectory again(now.p_W, now.v_W, waypoints, limits);
    EXPECT_NEAR(again.duration_s() + t, first.duration_s(), 1e-6) << t;
    for (double s = 0; s < again.duration_s(); s += 0.1) {
      EXPECT_LT((again.sample(s).p_W - first.sample(t + s).p_W).norm(), 1e-6) << t << " + " << s;
    }
  }
}

TEST(Trajectory, RefusesWhatIsNotFiniteAndLimitsThatAreNotPositive) {
  const std::vector<Waypoint> bad{{{NAN, 0, 0}, 1, 0}};
  EXPECT_THROW(Trajectory({0, 0, 0}, {0, 0, 0}, bad, {}), std::invalid_argument);
  EXPECT_THROW(Trajectory({0, 0, 0}, {0, INFINITY, 0}, {}, {}), std::invalid_argument);
  EXPECT_THROW(Trajectory({0, 0, 0}, {0, 0, 0}, {}, {.speed_max_m_s = 0.0}), std::invalid_argument);
}

}  // namespace
}  // namespace comptonaut
