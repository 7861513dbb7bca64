// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "flight/plan.h"

namespace comptonaut {

struct MotionLimits {
  double speed_max_m_s = 8.0;
  double acceleration_max_m_s2 = 3.6;
  double corner_deviation_max_m = 0.25;  ///< by which a corner may be cut
};

/// Motion at one moment, frame W.
struct Motion {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  ///< m
  Eigen::Vector3d v_W = Eigen::Vector3d::Zero();  ///< m/s
  Eigen::Vector3d a_W = Eigen::Vector3d::Zero();  ///< m/s^2
};

struct Profile;
struct StraightLeg;

/// A flight through waypoints as fast as the limits allow, position and velocity continuous: trapezoid speed along
/// straight legs, and at each corner a parabolic blend at constant acceleration [Kunz and Stilman 2011], which leaves
/// the corner by at most corner_deviation_max_m. It ends at rest on the last waypoint. The acceleration limit holds
/// everywhere, the speed limits from the end of the start manoeuvre on.
///
/// Start manoeuvre: from its velocity at the start to one towards the first waypoint at constant acceleration. It
/// ends within 2 v_start^2 / a_max of the start.
///
/// No waypoints: it brakes to a stop. Waypoint times are not waited for.
class Trajectory {
 public:
  /// At rest at p_W.
  explicit Trajectory(const Eigen::Vector3d& p_W);
  /// A waypoint whose speed_max_m_s is not positive takes the limits' one.
  /// Throws std::invalid_argument unless the limits are positive and all else is finite.
  Trajectory(const Eigen::Vector3d& p_W, const Eigen::Vector3d& v_W, std::span<const Waypoint> waypoints,
             const MotionLimits& limits);

  [[nodiscard]] double duration_s() const { return duration_s_; }

  /// Before 0: the start; after the end: at rest on the last point.
  [[nodiscard]] Motion sample(double t_s) const;

  /// Index of the waypoint that is flown to; the number of waypoints once the last one is reached.
  [[nodiscard]] std::size_t waypoint_at(double t_s) const;

  /// When the waypoint is passed, or reached if it is the last one; of a cut corner the middle of the cut.
  [[nodiscard]] double arrival_s(std::size_t waypoint) const;

 private:
  /// Constant acceleration from start_s until the next piece.
  struct Piece {
    double start_s;
    Motion motion;
    std::size_t waypoint;
  };

  void fly(const Profile& profile, double acceleration_m_s2, std::size_t waypoints);
  void fly_straight(const StraightLeg& leg, double from_m, double to_m, double v0, double v1, double a);
  void fly_corner(const StraightLeg& before, const StraightLeg& next, double from_m, double speed_m_s,
                  double acceleration_m_s2);
  void append(double duration_s, const Motion& motion, std::size_t waypoint);
  void rest_at(const Eigen::Vector3d& p_W, std::size_t waypoint);

  [[nodiscard]] const Piece& piece_at(double t_s) const;

  std::vector<Piece> pieces_;
  double duration_s_ = 0.0;
};

}  // namespace comptonaut
